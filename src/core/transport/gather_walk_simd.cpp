// The lanes of a vector hold neighbouring receivers of a row.

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "transport/gather_walk.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "transport/gather_walk_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "transport/gather_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace heightlight::HWY_NAMESPACE {

void walk_gather_lanes(const GatherTask& task, GatherSums& sums) { gather_tile(task, sums); }

}  // namespace heightlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace heightlight {

HWY_EXPORT(walk_gather_lanes);

void walk_gather(const GatherTask& task, GatherSums& sums) {
  HWY_DYNAMIC_DISPATCH(walk_gather_lanes)(task, sums);
}

}  // namespace heightlight
#endif
