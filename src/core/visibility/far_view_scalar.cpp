#include "visibility/far_view.h"

namespace heightlight {
namespace {

/// The highest of the lines seen so far, at each of three heights.
struct Envelope {
  std::array<float, FarView::kLines> z;
  std::array<float, FarView::kLines> slope;
  std::array<float, FarView::kLines> height;
  std::array<float, FarView::kLines> per_distance;

  Envelope(float lowest, float highest) : z{lowest, 0.5F * (lowest + highest), highest} {
    slope.fill(kNoHeight);
    height.fill(kNoHeight);
    per_distance.fill(kNowhere);
  }

  void see(float v, float per_d) {
    for (std::size_t i = 0; i < z.size(); ++i) {
      const float s = (v - z[i]) * per_d;
      if (!(s > slope[i])) continue;
      slope[i] = s;
      height[i] = v;
      per_distance[i] = per_d;
    }
  }
};

void look_at_ring(const WalkTile& tile, const AzimuthTable& azimuth, int ring, int row, int column,
                  Envelope& envelope) {
  const HeightWindow& window = tile.windows[static_cast<std::size_t>(ring)];
  for (const RingSample& sample : azimuth.rings[static_cast<std::size_t>(ring) - 1]) {
    const float height =
        window.at((row + sample.row) >> window.level, (column + sample.column) >> window.level);
    envelope.see(height, sample.per_distance);
  }
}

}  // namespace

void look_far_scalar(const WalkTile& tile, const AzimuthTable& azimuth, FarView& view) {
  const int rings = static_cast<int>(azimuth.rings.size());
  const ReceiverGroups& wide = tile.wide_groups;
  const ReceiverGroups& groups = tile.groups;
  for (int wide_row = 0; wide_row * wide.side < tile.rows; ++wide_row) {
    for (int wide_column = 0; wide_column < wide.across; ++wide_column) {
      const auto w = static_cast<std::size_t>(wide_row * wide.across + wide_column);
      const int row = tile.map_row + wide_row * wide.side + wide.side / 2;
      const int column = tile.map_column + wide_column * wide.side + wide.side / 2;
      Envelope shared(wide.lowest[w], wide.highest[w]);
      for (int ring = kWideGroupRing; ring <= rings; ++ring) {
        look_at_ring(tile, azimuth, ring, row, column, shared);
      }
      for (int child = 0; child < 4; ++child) {
        const int i = 2 * wide_row + child / 2;
        const int j = 2 * wide_column + child % 2;
        const auto g = static_cast<std::size_t>(i * groups.across + j);
        const int child_row = tile.map_row + i * groups.side + groups.side / 2;
        const int child_column = tile.map_column + j * groups.side + groups.side / 2;
        const float nearer = static_cast<float>(child_row - row) * azimuth.along_row +
                             static_cast<float>(child_column - column) * azimuth.along_column;
        Envelope own(groups.lowest[g], groups.highest[g]);
        for (std::size_t line = 0; line < shared.z.size(); ++line) {
          const float per_d = shared.per_distance[line];
          own.see(shared.height[line], per_d + nearer * per_d * per_d);
        }
        if (rings >= kGroupRing) look_at_ring(tile, azimuth, kGroupRing, child_row, child_column, own);
        for (std::size_t line = 0; line < own.z.size(); ++line) {
          view.height[line][g] = own.height[line];
          view.per_distance[line][g] = own.per_distance[line];
        }
      }
    }
  }
}

}  // namespace heightlight
