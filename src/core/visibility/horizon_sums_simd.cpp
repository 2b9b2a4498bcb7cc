// The lanes of the vector hold neighbouring receivers of a row. The arithmetic is the same as in
// horizon_terms.

#include "visibility/horizon_sums.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "visibility/horizon_sums_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "visibility/walk_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace heightlight::HWY_NAMESPACE {

HWY_INLINE HorizonTerms<VF> lane_terms(VF slope, VF tangent) {
  const auto is_there = hn::Gt(slope, hn::Set(kF, kNoSlope));
  const Elevation<VF> horizon = elevation(kF, hn::IfThenElse(is_there, slope, tangent));
  const VF zero = hn::Zero(kF);
  const VF one = hn::Set(kF, 1.0F);
  const VF sine = hn::IfThenElse(is_there, hn::Max(horizon.sine, zero), zero);
  const VF cosine = hn::IfThenElse(hn::Gt(sine, zero), horizon.cosine, one);
  return {hn::Mul(cosine, cosine), hn::Sub(one, sine), cosine, horizon.from_zenith};
}

/// Adds the terms of the horizons that look(walk, bunch) finds.
template <class Look>
HWY_INLINE void add_terms(const WalkTile& tile, const AzimuthTable& azimuth, HorizonSums& sums, Look&& look) {
  const LaneWalk walk(tile, azimuth);
  for (int row = 0; row < tile.rows; row += static_cast<int>(kBunch)) {
    for (int column = 0; column < tile.columns; column += static_cast<int>(hn::Lanes(kF))) {
      Bunch bunch = walk.begin(row, column);
      bunch.slope.fill(hn::Set(kF, kNoHeight));
      look(walk, bunch);
      for (std::size_t v = 0; v < kBunch; ++v) {
        const VF level = walk.level_slope(bunch, v);
        const HorizonTerms<VF> terms =
            lane_terms(hn::Sub(bunch.slope[v], level), hn::Sub(bunch.tangent[v], level));
        for (std::size_t k = 0; k < kHorizonMeans; ++k) {
          float* sum = sums.of[k].data() + bunch.at(v);
          hn::Store(hn::Add(hn::Load(kF, sum), terms[k]), kF, sum);
        }
      }
    }
  }
}

void add_horizons_lanes(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far,
                        HorizonSums& sums) {
  // A vector must span whole groups.
  if constexpr (hn::MaxLanes(kF) < WalkTile::kGroup) return add_horizons_scalar(tile, azimuth, far, sums);
  add_terms(tile, azimuth, sums, [&](const LaneWalk& walk, Bunch& bunch) HWY_ATTR {
    walk.look_near(bunch);
    walk.look_far(far, bunch);
  });
}

void add_horizons_within_lanes(const WalkTile& tile, const AzimuthTable& azimuth,
                               const DistanceTable& maximum_distance, HorizonSums& sums) {
  add_terms(tile, azimuth, sums, [&](const LaneWalk& walk, Bunch& bunch) HWY_ATTR {
    walk.look_near_within(maximum_distance, bunch);
    walk.look_at_rings_within(maximum_distance, bunch);
  });
}

}  // namespace heightlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace heightlight {

HWY_EXPORT(add_horizons_lanes);
HWY_EXPORT(add_horizons_within_lanes);

void add_horizons(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far, HorizonSums& sums) {
  HWY_DYNAMIC_DISPATCH(add_horizons_lanes)(tile, azimuth, far, sums);
}

void add_horizons_within(const WalkTile& tile, const AzimuthTable& azimuth,
                         const DistanceTable& maximum_distance, HorizonSums& sums) {
  HWY_DYNAMIC_DISPATCH(add_horizons_within_lanes)(tile, azimuth, maximum_distance, sums);
}

}  // namespace heightlight
#endif
