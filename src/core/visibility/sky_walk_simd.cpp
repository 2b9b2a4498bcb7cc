// The lanes of the vector hold neighbouring receivers of a row. The arithmetic is the same as in
// sky_walk_scalar.cpp.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "heightlight/forms.h"
#include "visibility/sky_walk.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "visibility/sky_walk_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "visibility/walk_lanes-inl.h"
// Must follow the headers that select the instruction set.
#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace heightlight::HWY_NAMESPACE {

/// What slices send from above a slope; as SliceSums in sky_walk_scalar.cpp.
struct SliceSums {
  VF sky, solid, along, up, along_squared, mixed;
};

HWY_INLINE SliceSums integrate_sums(VF c, VF n_z, VF m, const SkyWanted& wanted) {
  const Elevation<VF> horizon = elevation(kF, m);
  const Slice slice = integrate_slice(c, n_z, horizon);
  const VF zero = hn::Zero(kF);
  SliceSums sums{slice.sky, slice.solid, zero, zero, zero, zero};
  if (wanted.first) {
    const FirstMoments first = integrate_first(c, n_z, horizon);
    sums.along = first.along;
    sums.up = first.up;
  }
  if (wanted.second) {
    const SecondMoments second = integrate_second(c, n_z, horizon);
    sums.along_squared = second.along;
    sums.mixed = second.mixed;
  }
  return sums;
}

/// open += share × (above − next).
HWY_INLINE void add_between(VF share, const SliceSums& above, const SliceSums& next, const SkyWanted& wanted,
                            SliceSums& open) {
  open.sky = hn::MulAdd(share, hn::Sub(above.sky, next.sky), open.sky);
  open.solid = hn::MulAdd(share, hn::Sub(above.solid, next.solid), open.solid);
  if (wanted.first) {
    open.along = hn::MulAdd(share, hn::Sub(above.along, next.along), open.along);
    open.up = hn::MulAdd(share, hn::Sub(above.up, next.up), open.up);
  }
  if (wanted.second) {
    open.along_squared =
        hn::MulAdd(share, hn::Sub(above.along_squared, next.along_squared), open.along_squared);
    open.mixed = hn::MulAdd(share, hn::Sub(above.mixed, next.mixed), open.mixed);
  }
}

HWY_INLINE void add_to(float* sum, float factor, VF value) {
  hn::Store(hn::MulAdd(hn::Set(kF, factor), value, hn::Load(kF, sum)), kF, sum);
}

/// Adds the slices of vector v to its receivers' sums.
HWY_INLINE void add_slices(const WalkTile& tile, const AzimuthTable& azimuth, const Bunch& bunch,
                           std::size_t v, const SliceSums& slices, SkySums& sums) {
  const std::size_t at = bunch.at(v);
  const VF n_z = hn::Load(kF, tile.normal_z.data() + at);
  add_to(sums.sky.data() + at, 1, slices.sky);
  add_to(sums.solid.data() + at, 1, slices.solid);
  const auto is_steep = hn::Lt(hn::Mul(n_z, n_z), hn::Set(kF, 1 / (1 + sums.steep * sums.steep)));
  VF full = hn::Set(kF, 1.0F);
  if (HWY_UNLIKELY(!hn::AllFalse(kF, is_steep))) {
    const VF c = hn::Neg(hn::Mul(n_z, bunch.tangent[v]));
    full = hn::IfThenElse(is_steep, integrate_slice(c, n_z, elevation(kF, bunch.tangent[v])).sky, full);
  }
  add_to(sums.full.data() + at, 1, full);
  const float x = azimuth.world_x;
  const float y = azimuth.world_y;
  if (sums.wanted.first) {
    add_to(sums.first[0].data() + at, x, slices.along);
    add_to(sums.first[1].data() + at, y, slices.along);
    add_to(sums.first[2].data() + at, 1, slices.up);
  }
  if (sums.wanted.second) {
    add_to(sums.second[0].data() + at, x * x - y * y, slices.along_squared);
    add_to(sums.second[1].data() + at, x * y, slices.along_squared);
    add_to(sums.second[2].data() + at, 1, hn::Sub(slices.sky, slices.along_squared));
    add_to(sums.second[3].data() + at, x, slices.mixed);
    add_to(sums.second[4].data() + at, y, slices.mixed);
  }
}

/// Calls work(walk, bunch) for the receivers of the tile that walk. The bunch starts at the lowest slope that
/// sends anything.
template <class Work>
HWY_INLINE void for_bunches(const WalkTile& tile, const AzimuthTable& azimuth, const SkySums& sums,
                            Work&& work) {
  static_assert(kBunch == kSkyBlockRows && hn::MaxLanes(kF) <= kSkyBlockColumns);
  const LaneWalk walk(tile, azimuth);
  for (int row = 0; row < tile.rows; row += static_cast<int>(kBunch)) {
    for (int column = 0; column < tile.columns; column += static_cast<int>(hn::Lanes(kF))) {
      if (!sums.blocks[sky_block(row, column)]) continue;
      Bunch bunch = walk.begin(row, column);
      if (sums.below == BelowHorizontal::ground) {
        for (std::size_t v = 0; v < kBunch; ++v)
          bunch.slope[v] = hn::Max(bunch.slope[v], walk.level_slope(bunch, v));
      }
      work(walk, bunch);
    }
  }
}

/// Adds what lies above the horizons that look(walk, bunch) finds, for the receivers that walk.
template <class Look>
HWY_INLINE void add_above(const WalkTile& tile, const AzimuthTable& azimuth, SkySums& sums, Look&& look) {
  for_bunches(tile, azimuth, sums, [&](const LaneWalk& walk, Bunch& bunch) HWY_ATTR {
    look(walk, bunch);
    for (std::size_t v = 0; v < kBunch; ++v) {
      const std::size_t at = bunch.at(v);
      const VF n_z = hn::Load(kF, tile.normal_z.data() + at);
      const VF c = hn::Neg(hn::Mul(n_z, bunch.tangent[v]));
      if (sums.keep_slope) hn::Store(bunch.slope[v], kF, sums.slope.data() + at);
      add_slices(tile, azimuth, bunch, v, integrate_sums(c, n_z, bunch.slope[v], sums.wanted), sums);
    }
  });
}

void walk_sky_lanes(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far, SkySums& sums) {
  // A vector must span whole groups.
  if constexpr (hn::MaxLanes(kF) < WalkTile::kGroup) return walk_sky_scalar(tile, azimuth, far, sums);
  add_above(tile, azimuth, sums, [&](const LaneWalk& walk, Bunch& bunch) HWY_ATTR {
    walk.look_near(bunch);
    walk.look_far(far, bunch);
  });
}

HWY_INLINE VF slope_between(VF a, VF b) {
  const VF one = hn::Set(kF, 1.0F);
  const VF cosine_a = hn::Div(one, hn::Sqrt(hn::MulAdd(a, a, one)));
  const VF cosine_b = hn::Div(one, hn::Sqrt(hn::MulAdd(b, b, one)));
  return hn::Div(hn::MulAdd(a, cosine_a, hn::Mul(b, cosine_b)), hn::Add(cosine_a, cosine_b));
}

/// A stretch of the profile, per receiver: from the way `before`, where it is `begin` higher than the
/// receiver, to `way`, where it is `rise` higher.
struct Stretch {
  VF begin, rise;
  float before, way;
};

/// As openness in sky_walk_scalar.cpp.
VF openness(Falloff falloff, VF share) {
  if (falloff == Falloff::root) return hn::Sqrt(share);
  if (falloff != Falloff::exponential) return share;
  constexpr auto kRate = static_cast<float>(kOpennessRate);
  const VF fallen = hn::Exp(kF, hn::Mul(hn::Set(kF, -kRate), share));
  return hn::Mul(hn::Sub(hn::Set(kF, 1.0F), fallen), hn::Set(kF, -1 / std::expm1(-kRate)));
}

/// Mean of μ over stretches seen from slope m to `seen`; as share_of_stretch in sky_walk_scalar.cpp.
HWY_INLINE VF share_of_stretches(const Stretch& stretch, VF c, VF n_z, VF m, VF seen,
                                 const DistanceTable& maximum_distance) {
  if (stretch.before <= 0) return hn::Zero(kF);
  const VF one = hn::Set(kF, 1.0F);
  const VF zero = hn::Zero(kF);
  const VF first = hn::Set(kF, stretch.before);
  const VF last = hn::Set(kF, stretch.way);
  const VF g = hn::Mul(hn::Sub(stretch.rise, stretch.begin),
                       hn::Set(kF, 1 / run_between(stretch.before, stretch.way)));
  const VF p = hn::NegMulAdd(g, first, stretch.begin);
  const auto behind_hole = hn::Le(stretch.begin, hn::Set(kF, maximum_distance.deepest));
  const VF middle = slope_between(m, seen);
  VF weights = hn::Set(kF, 1e-20F);
  VF sum = zero;
  for (const bool upper : {false, true}) {
    const VF slope = upper ? slope_between(middle, seen) : slope_between(m, middle);
    const auto rises = hn::Lt(slope, g);
    const VF steeper = hn::IfThenElse(rises, hn::Sub(g, slope), one);
    const VF meets = hn::IfThenElse(rises, hn::Div(hn::Neg(p), steeper), first);
    const VF clamped = hn::Min(hn::Max(meets, first), last);
    const VF way = hn::IfThenElse(behind_hole, last, clamped);
    const VF squared = hn::MulAdd(slope, slope, one);
    const VF distance = hn::Mul(way, hn::Sqrt(squared));
    const VF share = hn::Min(one, hn::Div(distance, hn::Set(kF, maximum_distance.distance)));
    const VF weight = hn::Div(hn::Max(zero, hn::MulAdd(n_z, slope, c)), squared);
    weights = hn::Add(weights, weight);
    sum = hn::MulAdd(weight, openness(maximum_distance.falloff, share), sum);
  }
  return hn::Div(sum, weights);
}

/// For a sharp maximum distance; as slopes_inside in sky_walk_scalar.cpp.
struct SlopePair {
  VF low, high;
};
HWY_INLINE SlopePair slopes_inside(const Stretch& stretch, VF m, VF seen,
                                   const DistanceTable& maximum_distance) {
  if (stretch.before <= 0) return {m, seen};
  const VF squared = hn::Set(kF, maximum_distance.squared);
  const VF end = hn::MulAdd(stretch.rise, stretch.rise, hn::Set(kF, stretch.way * stretch.way));
  const VF whole = hn::IfThenElse(hn::Le(end, squared), seen, m);
  const VF zero = hn::Zero(kF);
  const VF first = hn::Set(kF, stretch.before);
  const VF last = hn::Set(kF, stretch.way);
  const VF g = hn::Mul(hn::Sub(stretch.rise, stretch.begin),
                       hn::Set(kF, 1 / run_between(stretch.before, stretch.way)));
  const VF p = hn::NegMulAdd(g, first, stretch.begin);
  const VF u = hn::MulAdd(g, g, hn::Set(kF, 1.0F));
  const VF root = hn::NegMulAdd(p, p, hn::Mul(squared, u));
  const VF half = hn::Sqrt(hn::Max(root, zero));
  const VF middle = hn::Mul(p, g);
  const VF enters = hn::Div(hn::Neg(hn::Add(half, middle)), u);
  const VF leaves = hn::Div(hn::Sub(half, middle), u);
  const VF low = hn::IfThenElse(hn::Gt(enters, first), hn::Add(hn::Div(p, hn::Max(enters, first)), g), m);
  const VF high = hn::IfThenElse(hn::Lt(leaves, last), hn::Add(hn::Div(p, hn::Max(leaves, first)), g), seen);
  const VF from = hn::Min(hn::Max(low, m), seen);
  const VF to = hn::Min(hn::Max(high, from), seen);
  const auto meets = hn::Gt(root, zero);
  const auto behind_hole = hn::Le(stretch.begin, hn::Set(kF, maximum_distance.deepest));
  return {hn::IfThenElse(behind_hole, m, hn::IfThenElse(meets, from, m)),
          hn::IfThenElse(behind_hole, whole, hn::IfThenElse(meets, to, m))};
}

HWY_INLINE void walk_chain(const WalkTile& tile, const AzimuthTable& azimuth,
                           const DistanceTable& maximum_distance, SkySums& sums) {
  for_bunches(tile, azimuth, sums, [&](const LaneWalk& walk, Bunch& bunch) HWY_ATTR {
    const VF zero = hn::Zero(kF);
    std::array<VF, kBunch> n_z, c;
    std::array<SliceSums, kBunch> open, above;
    for (std::size_t v = 0; v < kBunch; ++v) {
      n_z[v] = hn::Load(kF, tile.normal_z.data() + bunch.at(v));
      c[v] = hn::Neg(hn::Mul(n_z[v], bunch.tangent[v]));
      open[v] = {zero, zero, zero, zero, zero, zero};
      above[v] = integrate_sums(c[v], n_z[v], bunch.slope[v], sums.wanted);
    }
    const auto see = [&](std::size_t v, VF begin, float before, VF rise, float way, VF seen) HWY_ATTR {
      const VF m = bunch.slope[v];
      if (hn::AllFalse(kF, hn::Gt(seen, m))) return;
      const VF higher = hn::Max(m, seen);  // where nothing rises, nothing lies between `m` and `higher`
      const SliceSums next = integrate_sums(c[v], n_z[v], higher, sums.wanted);
      if (maximum_distance.falloff != Falloff::none) {
        const VF share =
            share_of_stretches({begin, rise, before, way}, c[v], n_z[v], m, higher, maximum_distance);
        add_between(share, above[v], next, sums.wanted, open[v]);
      } else {
        const SlopePair inside = slopes_inside({begin, rise, before, way}, m, higher, maximum_distance);
        const VF one = hn::Set(kF, 1.0F);
        add_between(one, above[v], integrate_sums(c[v], n_z[v], inside.low, sums.wanted), sums.wanted,
                    open[v]);
        add_between(one, integrate_sums(c[v], n_z[v], inside.high, sums.wanted), next, sums.wanted, open[v]);
      }
      above[v] = next;
      bunch.slope[v] = higher;
    };
    walk.for_stretches(maximum_distance, bunch, see);
    const SliceSums nothing{zero, zero, zero, zero, zero, zero};
    for (std::size_t v = 0; v < kBunch; ++v) {
      add_between(hn::Set(kF, 1.0F), above[v], nothing, sums.wanted, open[v]);
      add_slices(tile, azimuth, bunch, v, open[v], sums);
    }
  });
}

void walk_sky_within_lanes(const WalkTile& tile, const AzimuthTable& azimuth,
                           const DistanceTable& maximum_distance, SkySums& sums) {
  if (!sums.keep_slope) return walk_chain(tile, azimuth, maximum_distance, sums);
  add_above(tile, azimuth, sums, [&](const LaneWalk& walk, Bunch& bunch) HWY_ATTR {
    walk.look_near_within(maximum_distance, bunch);
    walk.look_at_rings_within(maximum_distance, bunch);
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

void walk_sky_within(const WalkTile& tile, const AzimuthTable& azimuth, const DistanceTable& maximum_distance,
                     SkySums& sums) {
  HWY_DYNAMIC_DISPATCH(walk_sky_within_lanes)(tile, azimuth, maximum_distance, sums);
}

}  // namespace heightlight
#endif
