#include "visibility/horizon_slope.h"

#include <algorithm>
#include <cmath>

namespace heightlight {
namespace {

/// Slope to the place where a stretch leaves the sphere of the maximum distance, given that it ends outside.
/// kNoHeight where there is no such place, or none that could be the horizon: where the stretch begins above
/// the sphere or behind a hole, or where its slope only falls. The line p + g t meets the sphere where (1 +
/// g²) t² + 2 p g t + p² = D².
float exit_slope(const ProfilePoint& begin, const ProfilePoint& end, const DistanceTable& maximum_distance) {
  const bool above = begin.rise > 0 && begin.squared() > maximum_distance.squared;
  if (begin.rise <= maximum_distance.deepest || above) return kNoHeight;
  const float g = (end.rise - begin.rise) / run_between(begin.way, end.way);
  const float p = begin.rise - g * begin.way;
  const float u = 1 + g * g;
  const float root = maximum_distance.squared * u - p * p;
  if (root < 0 || p >= 0) return kNoHeight;  // p ≥ 0: the slope p/t + g only falls
  const float way = (std::sqrt(root) - p * g) / u;
  constexpr float kRounding = 1e-5F;
  if (way < begin.way * (1 - kRounding) || way > end.way * (1 + kRounding)) return kNoHeight;
  return p / way + g;
}

}  // namespace

float near_slope(const WalkTile& tile, const AzimuthTable& azimuth, std::size_t k, int i, int j) {
  const NearSample& sample = azimuth.near[k];
  const int row = tile.map_row + i;
  const int column = tile.map_column + j;
  const HeightWindow& window = k < azimuth.lifted ? tile.windows[0] : tile.lifted;
  const float weighted = sample.weight[0] * window.at(row + sample.row[0], column + sample.column[0]) +
                         sample.weight[1] * window.at(row + sample.row[1], column + sample.column[1]);
  return weighted - sample.per_distance * tile.height[static_cast<std::size_t>(i * WalkTile::kSide + j)];
}

float ring_slope(const WalkTile& tile, const RingSample& sample, int ring, int i, int j) {
  const HeightWindow& window = tile.windows[static_cast<std::size_t>(ring)];
  const float height = window.at((tile.map_row + i + sample.row) >> window.level,
                                 (tile.map_column + j + sample.column) >> window.level);
  return (height - tile.height[static_cast<std::size_t>(i * WalkTile::kSide + j)]) * sample.per_distance;
}

float horizon_slope(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far, int i, int j,
                    float least) {
  const float z = tile.height[static_cast<std::size_t>(i * WalkTile::kSide + j)];
  float slope = least;
  for (std::size_t k = 0; k < azimuth.near.size(); ++k)
    slope = std::max(slope, near_slope(tile, azimuth, k, i, j));
  constexpr int kSide = WalkTile::kGroup;
  constexpr int kMiddle = kSide / 2;
  const auto group = static_cast<std::size_t>(i / kSide * (WalkTile::kSide / kSide) + j / kSide);
  const float nearer = static_cast<float>(i % kSide - kMiddle) * azimuth.along_row +
                       static_cast<float>(j % kSide - kMiddle) * azimuth.along_column;
  for (std::size_t line = 0; line < FarView::kLines; ++line) {
    const float per_d = far.per_distance[line][group];
    slope = std::max(slope, (far.height[line][group] - z) * (per_d + nearer * per_d * per_d));
  }
  return slope;
}

float horizon_slope_within(const WalkTile& tile, const AzimuthTable& azimuth,
                           const DistanceTable& maximum_distance, int i, int j, float least) {
  float slope = least;
  ProfilePoint begin;
  for (std::size_t k = 0; k < maximum_distance.near; ++k) {
    const NearSample& sample = azimuth.near[k];
    const float seen = near_slope(tile, azimuth, k, i, j);
    const float way = 1 / sample.per_distance;
    const ProfilePoint end{way, std::max(seen * way, maximum_distance.deepest)};
    const bool inside = end.squared() <= maximum_distance.squared;
    slope = std::max(slope, inside ? seen : exit_slope(begin, end, maximum_distance));
    begin = end;
  }
  for (std::size_t ring = 0; ring < maximum_distance.caps.size(); ++ring) {
    for (std::size_t k = 0; k < maximum_distance.caps[ring].size(); ++k) {
      const float seen = ring_slope(tile, azimuth.rings[ring][k], static_cast<int>(ring) + 1, i, j);
      slope = std::max(slope, std::min(seen, maximum_distance.caps[ring][k]));
    }
  }
  return slope;
}

}  // namespace heightlight
