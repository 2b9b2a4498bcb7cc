// The lanes of the vector hold neighbouring groups of a row. The arithmetic is far_view_scalar.cpp's.

#include <cstddef>
#include <cstdint>

#include "visibility/far_view.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "visibility/far_view_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace heightlight::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A row of wide groups is one vector, or several.
using F = hn::CappedTag<float, WalkTile::kSide / WalkTile::kWideGroup>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
constexpr F kF;
constexpr I kI;

struct Envelopes {
  std::array<VF, FarView::kLines> z, slope, height, per_distance;

  Envelopes(const ReceiverGroups& groups, std::size_t first) {
    const VF lowest = hn::LoadU(kF, groups.lowest.data() + first);
    const VF highest = hn::LoadU(kF, groups.highest.data() + first);
    z = {lowest, hn::Mul(hn::Set(kF, 0.5F), hn::Add(lowest, highest)), highest};
    slope.fill(hn::Set(kF, kNoHeight));
    height.fill(hn::Set(kF, kNoHeight));
    per_distance.fill(hn::Set(kF, kNowhere));
  }

  HWY_INLINE void see(VF v, VF per_d) {
    for (std::size_t i = 0; i < z.size(); ++i) {
      const VF s = hn::Mul(hn::Sub(v, z[i]), per_d);
      const auto leads = hn::Gt(s, slope[i]);
      slope[i] = hn::Max(slope[i], s);
      height[i] = hn::IfThenElse(leads, v, height[i]);
      per_distance[i] = hn::IfThenElse(leads, per_d, per_distance[i]);
    }
  }
};

/// Looks at a ring from groups `side` texels apart, the first of them at (row, column).
HWY_INLINE void look_at_ring(const WalkTile& tile, const AzimuthTable& azimuth, int ring, int row, int column,
                             int side, Envelopes& envelopes) {
  const HeightWindow& window = tile.windows[static_cast<std::size_t>(ring)];
  const int level = window.level;
  const auto spread = hn::Mul(hn::Iota(kI, 0), hn::Set(kI, side));
  for (const RingSample& sample : azimuth.rings[static_cast<std::size_t>(ring) - 1]) {
    const int start = column + sample.column;
    const float* first = window.values.data() +
                         std::ptrdiff_t{((row + sample.row) >> level) - window.first_row} * window.width +
                         ((start >> level) - window.first_column);
    const int phase = start & ((1 << level) - 1);
    const auto order = hn::IndicesFromVec(kF, hn::ShiftRightSame(hn::Add(hn::Set(kI, phase), spread), level));
    envelopes.see(hn::TableLookupLanes(hn::LoadU(kF, first), order), hn::Set(kF, sample.per_distance));
  }
}

/// The children of wide groups `half` (0: the first half of the vector, 1: the second), twice each.
HWY_INLINE VF twice(VF parents, int half) {
  const int lanes = static_cast<int>(hn::Lanes(kF));
  const auto order = hn::ShiftRight<1>(hn::Add(hn::Iota(kI, 0), hn::Set(kI, half * lanes)));
  return hn::TableLookupLanes(parents, hn::IndicesFromVec(kF, order));
}

/// Finishes a vector of groups in row i of the tile's groups, from group j on, below their parents' lines.
HWY_INLINE void look_from_children(const WalkTile& tile, const AzimuthTable& azimuth,
                                   const Envelopes& parents, int i, int j, int half, FarView& view) {
  const ReceiverGroups& groups = tile.groups;
  const std::size_t first = static_cast<std::size_t>(i * groups.across + j);
  Envelopes own(groups, first);
  // Children sit two texels before or behind the look-out of their parents.
  const float down = static_cast<float>(i % 2 == 0 ? -2 : 2) * azimuth.along_row;
  const VF right =
      hn::IfThenElse(hn::RebindMask(kF, hn::TestBit(hn::Iota(kI, 0), hn::Set(kI, 1))),
                     hn::Set(kF, 2 * azimuth.along_column), hn::Set(kF, -2 * azimuth.along_column));
  const VF nearer = hn::Add(hn::Set(kF, down), right);
  for (std::size_t line = 0; line < own.z.size(); ++line) {
    const VF per_d = twice(parents.per_distance[line], half);
    own.see(twice(parents.height[line], half), hn::MulAdd(hn::Mul(nearer, per_d), per_d, per_d));
  }
  if (static_cast<int>(azimuth.rings.size()) >= kGroupRing) {
    look_at_ring(tile, azimuth, kGroupRing, tile.first_row + i * groups.side + groups.side / 2,
                 tile.first_column + j * groups.side + groups.side / 2, groups.side, own);
  }
  for (std::size_t line = 0; line < own.z.size(); ++line) {
    hn::StoreU(own.height[line], kF, view.height[line].data() + first);
    hn::StoreU(own.per_distance[line], kF, view.per_distance[line].data() + first);
  }
}

void look_far_lanes(const WalkTile& tile, const AzimuthTable& azimuth, FarView& view) {
  // A vector holds the children of a wide group in pairs.
  if constexpr (hn::MaxLanes(kF) < 2) return look_far_scalar(tile, azimuth, view);
  const int rings = static_cast<int>(azimuth.rings.size());
  const int lanes = static_cast<int>(hn::Lanes(kF));
  const ReceiverGroups& wide = tile.wide_groups;
  for (int row = 0; row * wide.side < tile.rows; ++row) {
    for (int column = 0; column < wide.across; column += lanes) {
      Envelopes shared(wide, static_cast<std::size_t>(row * wide.across + column));
      for (int ring = kWideGroupRing; ring <= rings; ++ring) {
        look_at_ring(tile, azimuth, ring, tile.first_row + row * wide.side + wide.side / 2,
                     tile.first_column + column * wide.side + wide.side / 2, wide.side, shared);
      }
      for (int child = 0; child < 4; ++child) {
        look_from_children(tile, azimuth, shared, 2 * row + child / 2, 2 * column + child % 2 * lanes,
                           child % 2, view);
      }
    }
  }
}

}  // namespace heightlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace heightlight {

HWY_EXPORT(look_far_lanes);

void look_far(const WalkTile& tile, const AzimuthTable& azimuth, FarView& view) {
  HWY_DYNAMIC_DISPATCH(look_far_lanes)(tile, azimuth, view);
}

}  // namespace heightlight
#endif
