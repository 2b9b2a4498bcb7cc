#include <algorithm>
#include <cmath>
#include <numbers>

#include "visibility/sky_walk.h"

namespace heightlight {
namespace {

constexpr float kHalfPi = std::numbers::pi_v<float> / 2;

/// Slope of the horizon seen from the receiver in row i and column j of the tile, at least `tangent`.
float horizon_slope(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far, int i, int j,
                    float tangent) {
  const float z = tile.height[static_cast<std::size_t>(i * WalkTile::kSide + j)];
  const int row = tile.first_row + i;
  const int column = tile.first_column + j;
  float slope = tangent;
  for (const NearSample& sample : azimuth.near) {
    const HeightWindow& window = tile.windows[0];
    const float weighted = sample.weight[0] * window.at(row + sample.row[0], column + sample.column[0]) +
                           sample.weight[1] * window.at(row + sample.row[1], column + sample.column[1]);
    slope = std::max(slope, weighted - sample.per_distance * z);
  }
  constexpr int kSide = WalkTile::kGroup;
  const auto group = static_cast<std::size_t>(i / kSide * (WalkTile::kSide / kSide) + j / kSide);
  const float nearer = static_cast<float>(i % kSide - kSide / 2) * azimuth.along_row +
                       static_cast<float>(j % kSide - kSide / 2) * azimuth.along_column;
  for (std::size_t line = 0; line < FarView::kLines; ++line) {
    const float per_d = far.per_distance[line][group];
    slope = std::max(slope, (far.height[line][group] - z) * (per_d + nearer * per_d * per_d));
  }
  return slope;
}

}  // namespace

void walk_sky_scalar(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far, SkySums& sums) {
  for (int i = 0; i < tile.rows; ++i) {
    for (int j = 0; j < tile.columns; ++j) {
      const auto at = static_cast<std::size_t>(i * WalkTile::kSide + j);
      const float tangent = tile.slope_x[at] * azimuth.world_x + tile.slope_y[at] * azimuth.world_y;
      const float n_z = tile.normal_z[at];
      const float c = -n_z * tangent;
      const auto slice = [c, n_z](float m) {
        const float q = 1 / (1 + m * m);
        return c * (kHalfPi - std::atan(m) - m * q) + n_z * q;
      };
      const float m = horizon_slope(tile, azimuth, far, i, j, tangent);
      sums.sky[at] += slice(m);
      sums.full[at] += n_z * n_z * (1 + kSteep * kSteep) < 1 ? slice(tangent) : 1;
      sums.solid[at] += 1 - m / std::sqrt(1 + m * m);
    }
  }
}

}  // namespace heightlight
