// The walk with one lane per vector, whatever the machine has: the reference for the vector code.

#define HWY_COMPILE_ONLY_SCALAR
#include <hwy/highway.h>

#include "transport/gather_lanes-inl.h"

namespace heightlight {

void walk_gather_by_one(const GatherTask& task, GatherSums& sums) { HWY_NAMESPACE::gather_tile(task, sums); }

}  // namespace heightlight
