// How vector kernels walk: included once per target, by the files that Highway compiles for each.

#if defined(HEIGHTLIGHT_WALK_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HEIGHTLIGHT_WALK_LANES_INL_H
#undef HEIGHTLIGHT_WALK_LANES_INL_H
#else
#define HEIGHTLIGHT_WALK_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <array>
#include <numbers>

#include "core/arc_tangent-inl.h"
#include "visibility/far_view.h"
#include "visibility/sky_walk.h"

HWY_BEFORE_NAMESPACE();
namespace heightlight::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// At most two groups of receivers in a vector.
using F = hn::CappedTag<float, 2 * WalkTile::kGroup>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
using VI = hn::Vec<I>;
constexpr F kF;
constexpr I kI;

/// Vectors walked together, so that a sample's weights are fetched once for all of them.
constexpr std::size_t kBunch = 4;

/// Neighbouring receivers on their way.
struct Bunch {
  int row = 0;  ///< in the tile
  int column = 0;
  std::size_t first = 0;  ///< index in the tile's arrays
  std::array<VF, kBunch> height, tangent, slope;
};

/// Twice a slice's irradiance and its solid angle above the slope m; sky_walk.h has the derivation.
struct Slice {
  VF sky, solid;
};

HWY_INLINE Slice integrate_slice(VF c, VF n_z, VF m) {
  const VF one = hn::Set(kF, 1.0F);
  const VF half_pi = hn::Set(kF, std::numbers::pi_v<float> / 2);
  const VF q = hn::Div(one, hn::MulAdd(m, m, one));
  const VF zenith = hn::NegMulAdd(m, q, hn::Sub(half_pi, arc_tangent(kF, m)));
  return {hn::MulAdd(c, zenith, hn::Mul(n_z, q)), hn::NegMulAdd(m, hn::Sqrt(q), one)};
}

class LaneWalk {
 public:
  LaneWalk(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far)
      : tile_(tile), azimuth_(azimuth), far_(far) {}

  Bunch begin(int row, int column) const {
    Bunch bunch;
    bunch.row = row;
    bunch.column = column;
    bunch.first = static_cast<std::size_t>(row * WalkTile::kSide + column);
    for (std::size_t v = 0; v < kBunch; ++v) {
      const std::size_t at = bunch.first + v * hn::Lanes(kF);
      bunch.height[v] = hn::Load(kF, tile_.height.data() + at);
      bunch.tangent[v] =
          hn::MulAdd(hn::Load(kF, tile_.slope_x.data() + at), hn::Set(kF, azimuth_.world_x),
                     hn::Mul(hn::Load(kF, tile_.slope_y.data() + at), hn::Set(kF, azimuth_.world_y)));
      bunch.slope[v] = bunch.tangent[v];
    }
    return bunch;
  }

  void look_near(Bunch& bunch) const {
    const HeightWindow& window = tile_.windows[0];
    const float* here = window.values.data() +
                        std::ptrdiff_t{tile_.first_row + bunch.row - window.first_row} * window.width +
                        (tile_.first_column + bunch.column - window.first_column);
    for (const NearSample& sample : azimuth_.near) {
      const float* from = here + sample.offset[0];
      const float* to = here + sample.offset[1];
      const VF from_weight = hn::Set(kF, sample.weight[0]);
      const VF to_weight = hn::Set(kF, sample.weight[1]);
      const VF per_distance = hn::Set(kF, sample.per_distance);
      for (std::size_t v = 0; v < kBunch; ++v) {
        const std::size_t lane = v * hn::Lanes(kF);
        const VF above =
            hn::MulAdd(to_weight, hn::LoadU(kF, to + lane), hn::Mul(from_weight, hn::LoadU(kF, from + lane)));
        bunch.slope[v] = hn::Max(bunch.slope[v], hn::NegMulAdd(per_distance, bunch.height[v], above));
      }
    }
  }

  /// The lines that the groups of the bunch keep.
  void look_far(Bunch& bunch) const {
    constexpr int kSide = WalkTile::kGroup;
    const int lanes = static_cast<int>(hn::Lanes(kF));
    const auto group_of_lane = hn::ShiftRight<2>(hn::Iota(kI, 0));
    static_assert(kSide == 4);
    const auto order = hn::IndicesFromVec(kF, group_of_lane);
    // World distance from the look-out, in the middle of the group, to the receiver, along the azimuth.
    const VF column =
        hn::ConvertTo(kF, hn::Sub(hn::And(hn::Iota(kI, 0), hn::Set(kI, kSide - 1)), hn::Set(kI, kSide / 2)));
    const float row = static_cast<float>(bunch.row % kSide - kSide / 2);
    const VF nearer =
        hn::MulAdd(column, hn::Set(kF, azimuth_.along_column), hn::Set(kF, row * azimuth_.along_row));
    for (std::size_t line = 0; line < FarView::kLines; ++line) {
      for (std::size_t v = 0; v < kBunch; ++v) {
        const int group = bunch.row / kSide * (WalkTile::kSide / kSide) +
                          (bunch.column + static_cast<int>(v) * lanes) / kSide;
        const auto at = static_cast<std::size_t>(group);
        const VF height = hn::TableLookupLanes(hn::LoadU(kF, far_.height[line].data() + at), order);
        const VF per_d = hn::TableLookupLanes(hn::LoadU(kF, far_.per_distance[line].data() + at), order);
        raise(bunch, v, height, hn::MulAdd(hn::Mul(nearer, per_d), per_d, per_d));
      }
    }
  }

 private:
  static void raise(Bunch& bunch, std::size_t v, VF height, VF per_distance) {
    bunch.slope[v] = hn::Max(bunch.slope[v], hn::Mul(hn::Sub(height, bunch.height[v]), per_distance));
  }

  const WalkTile& tile_;
  const AzimuthTable& azimuth_;
  const FarView& far_;
};

}  // namespace heightlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
