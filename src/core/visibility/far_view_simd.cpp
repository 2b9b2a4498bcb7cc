// The lanes of the vector hold neighbouring groups of a row. The arithmetic is the same as in
// far_view_scalar.cpp.

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

// A row of groups is one vector, or several; so is a row of wide groups.
using Groups = hn::CappedTag<float, WalkTile::kSide / WalkTile::kGroup>;
using WideGroups = hn::CappedTag<float, WalkTile::kSide / WalkTile::kWideGroup>;

template <class D>
struct Envelopes {
  using V = hn::Vec<D>;
  static constexpr D kD{};

  std::array<V, FarView::kLines> z, slope, height, per_distance;

  Envelopes(const ReceiverGroups& groups, std::size_t first) {
    const V lowest = hn::LoadU(kD, groups.lowest.data() + first);
    const V highest = hn::LoadU(kD, groups.highest.data() + first);
    z = {lowest, hn::Mul(hn::Set(kD, 0.5F), hn::Add(lowest, highest)), highest};
    slope.fill(hn::Set(kD, kNoHeight));
    height.fill(hn::Set(kD, kNoHeight));
    per_distance.fill(hn::Set(kD, kNowhere));
  }

  HWY_INLINE void see(V v, V per_d) {
    for (std::size_t i = 0; i < z.size(); ++i) {
      const V s = hn::Mul(hn::Sub(v, z[i]), per_d);
      const auto leads = hn::Gt(s, slope[i]);
      slope[i] = hn::Max(slope[i], s);
      height[i] = hn::IfThenElse(leads, v, height[i]);
      per_distance[i] = hn::IfThenElse(leads, per_d, per_distance[i]);
    }
  }

  void store(float* heights, float* per_distances, std::size_t stride) const {
    for (std::size_t i = 0; i < z.size(); ++i) {
      hn::StoreU(height[i], kD, heights + i * stride);
      hn::StoreU(per_distance[i], kD, per_distances + i * stride);
    }
  }
};

/// Looks at a ring from groups `side` texels apart, the first of them at (row, column).
template <class D>
HWY_INLINE void look_at_ring(const WalkTile& tile, const AzimuthTable& azimuth, int ring, int row, int column,
                             int side, Envelopes<D>& envelopes) {
  constexpr D kD{};
  constexpr hn::RebindToSigned<D> kI{};
  const HeightWindow& window = tile.windows[static_cast<std::size_t>(ring)];
  const int level = window.level;
  const auto spread = hn::Mul(hn::Iota(kI, 0), hn::Set(kI, side));
  for (const RingSample& sample : azimuth.rings[static_cast<std::size_t>(ring) - 1]) {
    const int start = column + sample.column;
    const float* first = window.values.data() +
                         std::ptrdiff_t{((row + sample.row) >> level) - window.first_row} * window.width +
                         ((start >> level) - window.first_column);
    const auto per_distance = hn::Set(kD, sample.per_distance);
    if (side >> level == 2) {  // every other block
      hn::Vec<D> heights, between;
      hn::LoadInterleaved2(kD, first, heights, between);
      envelopes.see(heights, per_distance);
    } else {  // as many blocks as groups, or fewer
      const int phase = start & ((1 << level) - 1);
      const auto order =
          hn::IndicesFromVec(kD, hn::ShiftRightSame(hn::Add(hn::Set(kI, phase), spread), level));
      envelopes.see(hn::TableLookupLanes(hn::LoadU(kD, first), order), per_distance);
    }
  }
}

/// The lines of a row of wide groups, padded like FarView.
struct WideRow {
  static constexpr std::size_t kStride = WalkTile::kSide / WalkTile::kWideGroup + kReadPadding;
  std::array<float, FarView::kLines * kStride> height{};
  std::array<float, FarView::kLines * kStride> per_distance{};
};

void look_from_wide_groups(const WalkTile& tile, const AzimuthTable& azimuth, int i, WideRow& row) {
  const ReceiverGroups& groups = tile.wide_groups;
  const int rings = static_cast<int>(azimuth.rings.size());
  for (int j = 0; j < groups.across; j += static_cast<int>(hn::Lanes(WideGroups()))) {
    Envelopes<WideGroups> envelopes(groups, static_cast<std::size_t>(i * groups.across + j));
    for (int ring = kWideGroupRing; ring <= rings; ++ring) {
      look_at_ring(tile, azimuth, ring, tile.map_row + i * groups.side + groups.side / 2,
                   tile.map_column + j * groups.side + groups.side / 2, groups.side, envelopes);
    }
    envelopes.store(row.height.data() + j, row.per_distance.data() + j, WideRow::kStride);
  }
}

/// Finishes row i of the tile's groups, from the lines of the wide groups that they belong to.
void look_from_groups(const WalkTile& tile, const AzimuthTable& azimuth, const WideRow& wide, int i,
                      FarView& view) {
  constexpr Groups kD{};
  constexpr hn::RebindToSigned<Groups> kI{};
  const ReceiverGroups& groups = tile.groups;
  const auto each_twice = hn::IndicesFromVec(kD, hn::ShiftRight<1>(hn::Iota(kI, 0)));
  // The middle of a group is two texels before or behind the middle of its wide group.
  const float down = static_cast<float>(i % 2 == 0 ? -2 : 2) * azimuth.along_row;
  const auto is_second = hn::RebindMask(kD, hn::TestBit(hn::Iota(kI, 0), hn::Set(kI, 1)));
  const auto right = hn::IfThenElse(is_second, hn::Set(kD, 2 * azimuth.along_column),
                                    hn::Set(kD, -2 * azimuth.along_column));
  const auto nearer = hn::Add(hn::Set(kD, down), right);
  for (int j = 0; j < groups.across; j += static_cast<int>(hn::Lanes(kD))) {
    const auto first = static_cast<std::size_t>(i * groups.across + j);
    Envelopes<Groups> own(groups, first);
    for (std::size_t line = 0; line < FarView::kLines; ++line) {
      const std::size_t at = line * WideRow::kStride + static_cast<std::size_t>(j) / 2;
      const auto height = hn::TableLookupLanes(hn::LoadU(kD, wide.height.data() + at), each_twice);
      const auto per_d = hn::TableLookupLanes(hn::LoadU(kD, wide.per_distance.data() + at), each_twice);
      own.see(height, hn::MulAdd(hn::Mul(nearer, per_d), per_d, per_d));
    }
    if (static_cast<int>(azimuth.rings.size()) >= kGroupRing) {
      look_at_ring(tile, azimuth, kGroupRing, tile.map_row + i * groups.side + groups.side / 2,
                   tile.map_column + j * groups.side + groups.side / 2, groups.side, own);
    }
    own.store(view.height[0].data() + first, view.per_distance[0].data() + first, view.height[0].size());
  }
}

void look_far_lanes(const WalkTile& tile, const AzimuthTable& azimuth, FarView& view) {
  // Groups come in pairs that belong to one wide group.
  if constexpr (hn::MaxLanes(Groups()) < 2) return look_far_scalar(tile, azimuth, view);
  WideRow wide;
  for (int i = 0; i * WalkTile::kWideGroup < tile.rows; ++i) {
    look_from_wide_groups(tile, azimuth, i, wide);
    for (const int row : {2 * i, 2 * i + 1}) look_from_groups(tile, azimuth, wide, row, view);
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
