// The walk of vector kernels. Included once per target, by the files that Highway compiles for each target.

#if defined(HEIGHTLIGHT_WALK_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HEIGHTLIGHT_WALK_LANES_INL_H
#undef HEIGHTLIGHT_WALK_LANES_INL_H
#else
#define HEIGHTLIGHT_WALK_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/elevation-inl.h"
#include "visibility/far_view.h"
#include "visibility/sky_walk.h"

HWY_BEFORE_NAMESPACE();
namespace heightlight::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A vector holds the receivers of at most four groups.
using F = hn::CappedTag<float, std::size_t{4} * WalkTile::kGroup>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
using VI = hn::Vec<I>;
constexpr F kF;
constexpr I kI;

/// Number of rows walked together: the rows of a group. What is fetched for one row serves all of them.
constexpr std::size_t kBunch = WalkTile::kGroup;

/// Neighbouring receivers during a walk: one vector per row.
struct Bunch {
  int row = 0;  ///< row of the first receiver in the tile
  int column = 0;

  /// Index of vector v in the tile's arrays.
  std::size_t at(std::size_t v) const {
    return (static_cast<std::size_t>(row) + v) * WalkTile::kSide + static_cast<std::size_t>(column);
  }
  std::array<VF, kBunch> height, tangent, slope;
};

/// Above a horizon: twice a slice's irradiance, and its solid angle. sky_walk.h has the derivation.
struct Slice {
  VF sky, solid;
};

/// ζ = π/2 − h − sin h cos h.
HWY_INLINE VF zenith_part(const Elevation<VF>& horizon) {
  return hn::NegMulAdd(horizon.sine, horizon.cosine, horizon.from_zenith);
}

HWY_INLINE Slice integrate_slice(VF c, VF n_z, const Elevation<VF>& horizon) {
  const VF q = hn::Mul(horizon.cosine, horizon.cosine);
  return {hn::MulAdd(c, zenith_part(horizon), hn::Mul(n_z, q)), hn::Sub(hn::Set(kF, 1.0F), horizon.sine)};
}

/// Twice a slice's moments above a horizon: of ω along d and z, and of ω_d² and ω_d ω_z.
struct FirstMoments {
  VF along, up;
};
struct SecondMoments {
  VF along, mixed;
};

HWY_INLINE FirstMoments integrate_first(VF c, VF n_z, const Elevation<VF>& horizon) {
  const VF one = hn::Set(kF, 1.0F);
  const VF two_thirds = hn::Set(kF, 2.0F / 3);
  const VF s = horizon.sine;
  const VF e = hn::Sub(one, s);
  const VF mixed = hn::Mul(hn::Mul(horizon.cosine, horizon.cosine), horizon.cosine);
  const VF cubed_cosine = hn::Mul(hn::Mul(e, e), hn::Add(hn::Set(kF, 2.0F), s));
  const VF squared_sine = hn::Mul(e, hn::MulAdd(s, s, hn::Add(one, s)));
  return {hn::Mul(two_thirds, hn::MulAdd(c, cubed_cosine, hn::Mul(n_z, mixed))),
          hn::Mul(two_thirds, hn::MulAdd(c, mixed, hn::Mul(n_z, squared_sine)))};
}

HWY_INLINE SecondMoments integrate_second(VF c, VF n_z, const Elevation<VF>& horizon) {
  const VF two = hn::Set(kF, 2.0F);
  const VF zenith = zenith_part(horizon);
  const VF q = hn::Mul(horizon.cosine, horizon.cosine);
  const VF fourth = hn::Mul(hn::Set(kF, 0.25F), hn::Mul(q, q));
  const VF tilted = hn::Mul(hn::Mul(horizon.sine, horizon.cosine), hn::Mul(hn::Set(kF, 0.25F), q));  // m q²/4
  const VF along = hn::MulSub(hn::Set(kF, 0.375F), zenith, tilted);
  const VF mixed = hn::MulAdd(hn::Set(kF, 0.125F), zenith, tilted);
  return {hn::Mul(two, hn::MulAdd(c, along, hn::Mul(n_z, fourth))),
          hn::Mul(two, hn::MulAdd(c, fourth, hn::Mul(n_z, mixed)))};
}

class LaneWalk {
 public:
  LaneWalk(const WalkTile& tile, const AzimuthTable& azimuth) : tile_(tile), azimuth_(azimuth) {}

  Bunch begin(int row, int column) const {
    Bunch bunch;
    bunch.row = row;
    bunch.column = column;
    for (std::size_t v = 0; v < kBunch; ++v) {
      const std::size_t at = bunch.at(v);
      bunch.height[v] = hn::Load(kF, tile_.height.data() + at);
      bunch.tangent[v] =
          hn::MulAdd(hn::Load(kF, tile_.slope_x.data() + at), hn::Set(kF, azimuth_.world_x),
                     hn::Mul(hn::Load(kF, tile_.slope_y.data() + at), hn::Set(kF, azimuth_.world_y)));
      bunch.slope[v] = bunch.tangent[v];
    }
    return bunch;
  }

  /// Slope of what is level at each receiver of vector v.
  VF level_slope(const Bunch& bunch, std::size_t v) const {
    const std::size_t at = bunch.at(v);
    return hn::MulAdd(hn::Load(kF, tile_.level_x.data() + at), hn::Set(kF, azimuth_.world_x),
                      hn::Mul(hn::Load(kF, tile_.level_y.data() + at), hn::Set(kF, azimuth_.world_y)));
  }

  void look_near(Bunch& bunch) const {
    for_near(bunch, azimuth_.near.size(), [&](const NearSample&, std::size_t v, VF seen) HWY_ATTR {
      bunch.slope[v] = hn::Max(bunch.slope[v], seen);
    });
  }

  /// Looks at the near samples within a maximum distance, and at the places where the stretches between them
  /// leave its sphere.
  void look_near_within(const DistanceTable& maximum_distance, Bunch& bunch) const {
    std::array<VF, kBunch> begin_rise;
    begin_rise.fill(hn::Zero(kF));
    std::array<float, kBunch> begin_way{};
    const VF squared = hn::Set(kF, maximum_distance.squared);
    const VF deepest = hn::Set(kF, maximum_distance.deepest);
    for_near(bunch, maximum_distance.near, [&](const NearSample& sample, std::size_t v, VF seen) HWY_ATTR {
      const float way = 1 / sample.per_distance;
      const VF rise = hn::Max(hn::Mul(seen, hn::Set(kF, way)), deepest);
      const auto outside = hn::Gt(hn::MulAdd(rise, rise, hn::Set(kF, way * way)), squared);
      bunch.slope[v] = hn::IfThenElse(outside, bunch.slope[v], hn::Max(bunch.slope[v], seen));
      const VF begin = begin_rise[v];
      const float before = begin_way[v];
      const auto above = hn::And(hn::Gt(begin, hn::Zero(kF)),
                                 hn::Gt(hn::MulAdd(begin, begin, hn::Set(kF, before * before)), squared));
      const auto leaves = hn::AndNot(above, hn::And(outside, hn::Gt(begin, deepest)));
      if (!hn::AllFalse(kF, leaves)) {
        const VF slope = exit_slope(begin, before, rise, way, squared);
        bunch.slope[v] = hn::IfThenElse(leaves, hn::Max(bunch.slope[v], slope), bunch.slope[v]);
      }
      begin_rise[v] = rise;
      begin_way[v] = way;
    });
  }

  /// Looks at the rings within a maximum distance, from every receiver separately.
  void look_at_rings_within(const DistanceTable& maximum_distance, Bunch& bunch) const {
    for_ring_samples(bunch, maximum_distance,
                     [&](const RingSample&, float cap, std::size_t v, VF seen) HWY_ATTR {
                       bunch.slope[v] = hn::Max(bunch.slope[v], hn::Min(seen, hn::Set(kF, cap)));
                     });
  }

  /// Calls see(v, begin, before, rise, way, slope) for every stretch of the profile that begins within a
  /// maximum distance. The stretch leads from the way `before`, where it is `begin` higher than the receiver,
  /// to `way`, where it is `rise` higher than the receiver and is seen under `slope`.
  template <class See>
  HWY_INLINE void for_stretches(const DistanceTable& maximum_distance, const Bunch& bunch, See&& see) const {
    std::array<VF, kBunch> begin_rise;
    begin_rise.fill(hn::Zero(kF));
    std::array<float, kBunch> begin_way{};
    const VF deepest = hn::Set(kF, maximum_distance.deepest);
    const auto end_at = [&](float way, std::size_t v, VF seen) HWY_ATTR {
      const VF rise = hn::Max(hn::Mul(seen, hn::Set(kF, way)), deepest);
      see(v, begin_rise[v], begin_way[v], rise, way, seen);
      begin_rise[v] = rise;
      begin_way[v] = way;
    };
    for_near(bunch, maximum_distance.near, [&](const NearSample& sample, std::size_t v, VF seen) HWY_ATTR {
      end_at(1 / sample.per_distance, v, seen);
    });
    for_ring_samples(bunch, maximum_distance,
                     [&](const RingSample& sample, float, std::size_t v, VF seen)
                         HWY_ATTR { end_at(1 / sample.per_distance, v, seen); });
  }

  /// Looks at the lines that the groups of the bunch keep (far_view.h).
  void look_far(const FarView& far, Bunch& bunch) const {
    constexpr int kSide = WalkTile::kGroup;
    constexpr int kMiddle = kSide / 2;
    static_assert(kSide == 4);
    const auto order = hn::IndicesFromVec(kF, hn::ShiftRight<2>(hn::Iota(kI, 0)));
    const auto at =
        static_cast<std::size_t>(bunch.row / kSide * (WalkTile::kSide / kSide) + bunch.column / kSide);
    // World distance along the azimuth from the texel in the group's middle to the receiver.
    const VF column =
        hn::ConvertTo(kF, hn::Sub(hn::And(hn::Iota(kI, 0), hn::Set(kI, kSide - 1)), hn::Set(kI, kMiddle)));
    std::array<VF, kBunch> nearer;
    for (std::size_t v = 0; v < kBunch; ++v) {
      const float row = static_cast<float>(static_cast<int>(v) - kMiddle);
      nearer[v] =
          hn::MulAdd(column, hn::Set(kF, azimuth_.along_column), hn::Set(kF, row * azimuth_.along_row));
    }
    for (std::size_t line = 0; line < FarView::kLines; ++line) {
      const VF height = hn::TableLookupLanes(hn::LoadU(kF, far.height[line].data() + at), order);
      const VF per_d = hn::TableLookupLanes(hn::LoadU(kF, far.per_distance[line].data() + at), order);
      for (std::size_t v = 0; v < kBunch; ++v)
        raise(bunch, v, height, hn::MulAdd(hn::Mul(nearer[v], per_d), per_d, per_d));
    }
  }

 private:
  static void raise(Bunch& bunch, std::size_t v, VF height, VF per_distance) {
    bunch.slope[v] = hn::Max(bunch.slope[v], hn::Mul(hn::Sub(height, bunch.height[v]), per_distance));
  }

  /// Calls see(sample, v, slope) for the first `count` near samples and each vector of the bunch.
  template <class See>
  HWY_INLINE void for_near(const Bunch& bunch, std::size_t count, See&& see) const {
    const std::size_t lifted = std::min(count, azimuth_.lifted);
    for_near_of(bunch, tile_.windows[0], 0, lifted, see);
    for_near_of(bunch, tile_.lifted, lifted, count, see);
  }

  /// As for_near, for near samples `first` to `end` only, which read the heights of one window.
  template <class See>
  HWY_INLINE void for_near_of(const Bunch& bunch, const HeightWindow& window, std::size_t first,
                              std::size_t end, See& see) const {
    const float* here = window.address(tile_.map_row + bunch.row, tile_.map_column + bunch.column);
    for (std::size_t k = first; k < end; ++k) {
      const NearSample& sample = azimuth_.near[k];
      const float* from = here + sample.offset[0];
      const float* to = here + sample.offset[1];
      const VF from_weight = hn::Set(kF, sample.weight[0]);
      const VF to_weight = hn::Set(kF, sample.weight[1]);
      const VF per_distance = hn::Set(kF, sample.per_distance);
      const auto see_between = [&](std::size_t v, VF from_height, VF to_height) HWY_ATTR {
        const VF above = hn::MulAdd(to_weight, to_height, hn::Mul(from_weight, from_height));
        see(sample, v, hn::NegMulAdd(per_distance, bunch.height[v], above));
      };
      if (to - from == window.width) {  // the lower sample of one row is the upper sample of the next
        VF own = hn::LoadU(kF, from);
        for (std::size_t v = 0; v < kBunch; ++v, to += window.width) {
          const VF below = hn::LoadU(kF, to);
          see_between(v, own, below);
          own = below;
        }
      } else {
        for (std::size_t v = 0; v < kBunch; ++v, from += window.width, to += window.width)
          see_between(v, hn::LoadU(kF, from), hn::LoadU(kF, to));
      }
    }
  }

  /// Slope at which the stretch from (before, begin) to (way, rise) leaves the sphere of the maximum
  /// distance, kNoHeight where it does not: horizon_slope.cpp has the derivation.
  static VF exit_slope(VF begin, float before, VF rise, float way, VF squared) {
    constexpr float kRounding = 1e-5F;
    const VF g = hn::Mul(hn::Sub(rise, begin), hn::Set(kF, 1 / run_between(before, way)));
    const VF p = hn::NegMulAdd(g, hn::Set(kF, before), begin);
    const VF u = hn::MulAdd(g, g, hn::Set(kF, 1.0F));
    const VF root = hn::NegMulAdd(p, p, hn::Mul(squared, u));
    const VF at = hn::Div(hn::NegMulAdd(p, g, hn::Sqrt(hn::Max(root, hn::Zero(kF)))), u);
    const auto meets = hn::And(hn::And(hn::Ge(root, hn::Zero(kF)), hn::Lt(p, hn::Zero(kF))),
                               hn::And(hn::Ge(at, hn::Set(kF, before * (1 - kRounding))),
                                       hn::Le(at, hn::Set(kF, way * (1 + kRounding)))));
    return hn::IfThenElse(meets, hn::Add(hn::Div(p, at), g), hn::Set(kF, kNoHeight));
  }

  /// Calls see(sample, cap, v, slope) for the ring samples within a maximum distance and each vector of the
  /// bunch. Each receiver looks at its own block. Neighbours in a vector share some blocks, so that one load,
  /// permuted, gives all heights.
  template <class See>
  HWY_INLINE void for_ring_samples(const Bunch& bunch, const DistanceTable& maximum_distance,
                                   See&& see) const {
    for (std::size_t ring = 0; ring < maximum_distance.caps.size(); ++ring) {
      const HeightWindow& window = tile_.windows[ring + 1];
      const int level = window.level;
      for (std::size_t k = 0; k < maximum_distance.caps[ring].size(); ++k) {
        const RingSample& sample = azimuth_.rings[ring][k];
        const int first = tile_.map_column + bunch.column + sample.column;
        const float* column = window.values.data() + (first >> level) - window.first_column;
        const VI blocks = hn::ShiftRightSame(hn::Iota(kI, first & ((1 << level) - 1)), level);
        const auto order = hn::IndicesFromVec(kF, blocks);
        const VF per_distance = hn::Set(kF, sample.per_distance);
        for (std::size_t v = 0; v < kBunch; ++v) {
          const int row = (tile_.map_row + bunch.row + static_cast<int>(v) + sample.row) >> level;
          const float* blocks_of_row = column + std::ptrdiff_t{row - window.first_row} * window.width;
          const VF height = hn::TableLookupLanes(hn::LoadU(kF, blocks_of_row), order);
          see(sample, maximum_distance.caps[ring][k], v,
              hn::Mul(hn::Sub(height, bunch.height[v]), per_distance));
        }
      }
    }
  }

  const WalkTile& tile_;
  const AzimuthTable& azimuth_;
};

}  // namespace heightlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
