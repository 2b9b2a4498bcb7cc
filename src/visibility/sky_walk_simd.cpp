// The lanes of the vector hold neighbouring receivers of a row. The arithmetic is sky_walk_scalar.cpp's.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "visibility/sky_walk.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "visibility/sky_walk_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "visibility/walk_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace heightlight::HWY_NAMESPACE {

HWY_INLINE void add_to(float* sum, VF weight, VF value) {
  hn::Store(hn::MulAdd(weight, value, hn::Load(kF, sum)), kF, sum);
}

/// Adds the slices above the horizons of vector v to its receivers' sums.
HWY_INLINE void add_slices(const WalkTile& tile, const AzimuthTable& azimuth, const Bunch& bunch,
                           std::size_t v, float weight, SkySums& sums) {
  const VF one = hn::Set(kF, 1.0F);
  const VF steep = hn::Set(kF, 1 / (1 + kSteep * kSteep));
  const VF share = hn::Set(kF, weight);
  const std::size_t at = bunch.first + v * hn::Lanes(kF);
  const VF n_z = hn::Load(kF, tile.normal_z.data() + at);
  const VF c = hn::Neg(hn::Mul(n_z, bunch.tangent[v]));
  const VF m = bunch.slope[v];
  const Slice slice = integrate_slice(c, n_z, m);
  add_to(sums.sky.data() + at, share, slice.sky);
  add_to(sums.solid.data() + at, share, slice.solid);
  const auto is_steep = hn::Lt(hn::Mul(n_z, n_z), steep);
  VF full = one;
  if (HWY_UNLIKELY(!hn::AllFalse(kF, is_steep))) {
    full = hn::IfThenElse(is_steep, integrate_slice(c, n_z, bunch.tangent[v]).sky, one);
  }
  add_to(sums.full.data() + at, share, full);
  if (sums.keep_slope) hn::Store(m, kF, sums.slope.data() + at);
  const float x = azimuth.world_x;
  const float y = azimuth.world_y;
  if (sums.wanted.first) {
    const FirstMoments moments = integrate_first(c, n_z, m);
    add_to(sums.first[0].data() + at, hn::Set(kF, weight * x), moments.along);
    add_to(sums.first[1].data() + at, hn::Set(kF, weight * y), moments.along);
    add_to(sums.first[2].data() + at, share, moments.up);
  }
  if (sums.wanted.second) {
    const SecondMoments moments = integrate_second(c, n_z, m);
    add_to(sums.second[0].data() + at, hn::Set(kF, weight * (x * x - y * y)), moments.along);
    add_to(sums.second[1].data() + at, hn::Set(kF, weight * (x * y)), moments.along);
    add_to(sums.second[2].data() + at, share, hn::Sub(slice.sky, moments.along));
    add_to(sums.second[3].data() + at, hn::Set(kF, weight * x), moments.mixed);
    add_to(sums.second[4].data() + at, hn::Set(kF, weight * y), moments.mixed);
  }
}

/// Calls look(walk, bunch) for all receivers of the tile and adds what is above their horizons.
template <class Look>
HWY_INLINE void for_bunches(const WalkTile& tile, const AzimuthTable& azimuth, float weight, SkySums& sums,
                            Look&& look) {
  const LaneWalk walk(tile, azimuth);
  for (int row = 0; row < tile.rows; ++row) {
    for (int column = 0; column < tile.columns; column += static_cast<int>(kBunch * hn::Lanes(kF))) {
      Bunch bunch = walk.begin(row, column);
      look(walk, bunch);
      for (std::size_t v = 0; v < kBunch; ++v) add_slices(tile, azimuth, bunch, v, weight, sums);
    }
  }
}

void walk_sky_lanes(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far, SkySums& sums) {
  // A vector spans whole groups.
  if constexpr (hn::MaxLanes(kF) < WalkTile::kGroup) return walk_sky_scalar(tile, azimuth, far, sums);
  for_bunches(tile, azimuth, 1, sums, [&](const LaneWalk& walk, Bunch& bunch) HWY_ATTR {
    walk.look_near(bunch);
    walk.look_far(far, bunch);
    walk.look_at_ring(bunch);
  });
}

void walk_sky_within_lanes(const WalkTile& tile, const AzimuthTable& azimuth, const ReachTable& reach,
                           float weight, SkySums& sums) {
  for_bunches(tile, azimuth, weight, sums, [&](const LaneWalk& walk, Bunch& bunch) HWY_ATTR {
    walk.look_near_within(reach, bunch);
    walk.look_at_rings_within(reach, bunch);
  });
}

}  // namespace heightlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace heightlight {

HWY_EXPORT(walk_sky_lanes);
HWY_EXPORT(walk_sky_within_lanes);

void walk_sky(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far, SkySums& sums) {
  HWY_DYNAMIC_DISPATCH(walk_sky_lanes)(tile, azimuth, far, sums);
}

void walk_sky_within(const WalkTile& tile, const AzimuthTable& azimuth, const ReachTable& reach, float weight,
                     SkySums& sums) {
  HWY_DYNAMIC_DISPATCH(walk_sky_within_lanes)(tile, azimuth, reach, weight, sums);
}

}  // namespace heightlight
#endif
