// The walk with one lane a vector, whatever the machine has: what the lanes must agree with.

#define HWY_COMPILE_ONLY_SCALAR
#include <hwy/highway.h>

#include "transport/gather_lanes-inl.h"

namespace heightlight {

void walk_gather_by_one(const GatherTask& task, GatherSums& sums) { HWY_NAMESPACE::gather_tile(task, sums); }

}  // namespace heightlight
