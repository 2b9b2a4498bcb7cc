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

void walk_sky_lanes(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far, SkySums& sums) {
  // A vector spans whole groups.
  if constexpr (hn::MaxLanes(kF) < WalkTile::kGroup) return walk_sky_scalar(tile, azimuth, far, sums);
  const LaneWalk walk(tile, azimuth, far);
  const VF one = hn::Set(kF, 1.0F);
  const VF steep = hn::Set(kF, 1 / (1 + kSteep * kSteep));
  for (int row = 0; row < tile.rows; ++row) {
    for (int column = 0; column < tile.columns; column += static_cast<int>(kBunch * hn::Lanes(kF))) {
      Bunch bunch = walk.begin(row, column);
      walk.look_near(bunch);
      walk.look_far(bunch);
      for (std::size_t v = 0; v < kBunch; ++v) {
        const std::size_t at = bunch.first + v * hn::Lanes(kF);
        const VF n_z = hn::Load(kF, tile.normal_z.data() + at);
        const VF c = hn::Neg(hn::Mul(n_z, bunch.tangent[v]));
        const VF m = bunch.slope[v];
        const Slice slice = integrate_slice(c, n_z, m);
        hn::Store(hn::Add(hn::Load(kF, sums.sky.data() + at), slice.sky), kF, sums.sky.data() + at);
        hn::Store(hn::Add(hn::Load(kF, sums.solid.data() + at), slice.solid), kF, sums.solid.data() + at);
        const auto is_steep = hn::Lt(hn::Mul(n_z, n_z), steep);
        VF full = one;
        if (HWY_UNLIKELY(!hn::AllFalse(kF, is_steep))) {
          full = hn::IfThenElse(is_steep, integrate_slice(c, n_z, bunch.tangent[v]).sky, one);
        }
        hn::Store(hn::Add(hn::Load(kF, sums.full.data() + at), full), kF, sums.full.data() + at);
      }
    }
  }
}

}  // namespace heightlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace heightlight {

HWY_EXPORT(walk_sky_lanes);

void walk_sky(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far, SkySums& sums) {
  HWY_DYNAMIC_DISPATCH(walk_sky_lanes)(tile, azimuth, far, sums);
}

}  // namespace heightlight
#endif
