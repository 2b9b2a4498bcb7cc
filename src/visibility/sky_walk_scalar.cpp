#include <algorithm>
#include <cmath>
#include <numbers>

#include "visibility/sky_walk.h"

namespace heightlight {
namespace {

constexpr float kHalfPi = std::numbers::pi_v<float> / 2;

/// Slope under which the receiver in row i and column j of the tile sees a near sample.
float near_slope(const WalkTile& tile, const NearSample& sample, int i, int j) {
  const int row = tile.first_row + i;
  const int column = tile.first_column + j;
  const HeightWindow& window = tile.windows[0];
  const float weighted = sample.weight[0] * window.at(row + sample.row[0], column + sample.column[0]) +
                         sample.weight[1] * window.at(row + sample.row[1], column + sample.column[1]);
  return weighted - sample.per_distance * tile.height[static_cast<std::size_t>(i * WalkTile::kSide + j)];
}

float ring_slope(const WalkTile& tile, const RingSample& sample, int level, int i, int j) {
  const int row = tile.first_row + i;
  const int column = tile.first_column + j;
  const float height = tile.windows[static_cast<std::size_t>(level)].at((row + sample.row) >> level,
                                                                        (column + sample.column) >> level);
  return (height - tile.height[static_cast<std::size_t>(i * WalkTile::kSide + j)]) * sample.per_distance;
}

/// Slope of the horizon seen from the receiver in row i and column j of the tile, at least `tangent`.
float horizon_slope(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far, int i, int j,
                    float tangent) {
  const float z = tile.height[static_cast<std::size_t>(i * WalkTile::kSide + j)];
  float slope = tangent;
  for (const NearSample& sample : azimuth.near) slope = std::max(slope, near_slope(tile, sample, i, j));
  if (!azimuth.rings.empty()) {
    for (const RingSample& sample : azimuth.rings[0]) {
      slope = std::max(slope, ring_slope(tile, sample, 1, i, j));
    }
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

/// A point of the profile: its distance and its height from the receiver's.
struct ProfilePoint {
  float way = 0;
  float rise = 0;

  float squared() const { return rise * rise + way * way; }
};

/// Slope to the place where the stretch between two points leaves the sphere of the reach, if it does and
/// ends above or beyond it; else −∞. The line p + g t meets the sphere where (1 + g²) t² + 2 p g t + p² = D².
float exit_slope(const ProfilePoint& begin, const ProfilePoint& end, const ReachTable& reach) {
  const bool above = begin.rise > 0 && begin.squared() > reach.squared;
  if (begin.rise <= reach.deepest || above) return kNoHeight;
  const float g = (end.rise - begin.rise) / (end.way - begin.way);
  const float p = begin.rise - g * begin.way;
  const float u = 1 + g * g;
  const float root = reach.squared * u - p * p;
  if (root < 0) return kNoHeight;
  const float way = (std::sqrt(root) - p * g) / u;
  constexpr float kRounding = 1e-5F;
  if (way < begin.way * (1 - kRounding) || way > end.way * (1 + kRounding)) return kNoHeight;
  return p / way + g;
}

/// Likewise, of what lies within the reach.
float horizon_slope_within(const WalkTile& tile, const AzimuthTable& azimuth, const ReachTable& reach, int i,
                           int j, float tangent) {
  float slope = tangent;
  ProfilePoint begin;
  for (std::size_t k = 0; k < reach.near; ++k) {
    const NearSample& sample = azimuth.near[k];
    const float seen = near_slope(tile, sample, i, j);
    const float way = 1 / sample.per_distance;
    const ProfilePoint end{way, std::max(seen * way, reach.deepest)};
    const bool inside = end.squared() <= reach.squared;
    slope = std::max(slope, inside ? seen : exit_slope(begin, end, reach));
    begin = end;
  }
  for (std::size_t ring = 0; ring < reach.caps.size(); ++ring) {
    for (std::size_t k = 0; k < reach.caps[ring].size(); ++k) {
      const float seen = ring_slope(tile, azimuth.rings[ring][k], static_cast<int>(ring) + 1, i, j);
      slope = std::max(slope, std::min(seen, reach.caps[ring][k]));
    }
  }
  return slope;
}

/// Adds the slice above slope m to the sums of a receiver.
void add_slice(const WalkTile& tile, const AzimuthTable& azimuth, std::size_t at, float tangent, float m,
               float weight, SkySums& sums) {
  const float n_z = tile.normal_z[at];
  const float c = -n_z * tangent;
  const auto slice = [c, n_z](float slope) {
    const float q = 1 / (1 + slope * slope);
    return c * (kHalfPi - std::atan(slope) - slope * q) + n_z * q;
  };
  const float sky = slice(m);
  const float q = 1 / (1 + m * m);
  const float s = m * std::sqrt(q);
  sums.sky[at] += weight * sky;
  sums.full[at] += weight * (n_z * n_z * (1 + kSteep * kSteep) < 1 ? slice(tangent) : 1);
  sums.solid[at] += weight * (1 - s);
  if (sums.keep_slope) sums.slope[at] = m;
  const float x = azimuth.world_x;
  const float y = azimuth.world_y;
  if (sums.wanted.first) {
    const float e = 1 - s;
    const float mixed = q * std::sqrt(q);
    const float along = 2 * weight / 3 * (c * (e * e * (2 + s)) + n_z * mixed);
    sums.first[0][at] += along * x;
    sums.first[1][at] += along * y;
    sums.first[2][at] += 2 * weight / 3 * (c * mixed + n_z * (e * (1 + s + s * s)));
  }
  if (sums.wanted.second) {
    const float zenith = kHalfPi - std::atan(m) - m * q;
    const float fourth = q * q / 4;
    const float along = 2 * (c * (0.375F * zenith - m * fourth) + n_z * fourth);
    const float mixed = 2 * weight * (c * fourth + n_z * (zenith / 8 + m * fourth));
    sums.second[0][at] += weight * along * (x * x - y * y);
    sums.second[1][at] += weight * along * (x * y);
    sums.second[2][at] += weight * (sky - along);
    sums.second[3][at] += mixed * x;
    sums.second[4][at] += mixed * y;
  }
}

/// Calls horizon(i, j, tangent) for every receiver of the tile and adds what is above.
template <class Horizon>
void for_receivers(const WalkTile& tile, const AzimuthTable& azimuth, float weight, SkySums& sums,
                   Horizon&& horizon) {
  for (int i = 0; i < tile.rows; ++i) {
    for (int j = 0; j < tile.columns; ++j) {
      const auto at = static_cast<std::size_t>(i * WalkTile::kSide + j);
      const float tangent = tile.slope_x[at] * azimuth.world_x + tile.slope_y[at] * azimuth.world_y;
      add_slice(tile, azimuth, at, tangent, horizon(i, j, tangent), weight, sums);
    }
  }
}

}  // namespace

void SkySums::clear() {
  for (Values* sums : {&sky, &full, &solid}) sums->fill(0);
  if (wanted.first) first.fill({});
  if (wanted.second) second.fill({});
}

void walk_sky_scalar(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far, SkySums& sums) {
  for_receivers(tile, azimuth, 1, sums, [&](int i, int j, float tangent) {
    return horizon_slope(tile, azimuth, far, i, j, tangent);
  });
}

void walk_sky_within_scalar(const WalkTile& tile, const AzimuthTable& azimuth, const ReachTable& reach,
                            float weight, SkySums& sums) {
  for_receivers(tile, azimuth, weight, sums, [&](int i, int j, float tangent) {
    return horizon_slope_within(tile, azimuth, reach, i, j, tangent);
  });
}

}  // namespace heightlight
