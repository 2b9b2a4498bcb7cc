#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "heightlight/forms.h"
#include "visibility/horizon_slope.h"
#include "visibility/sky_walk.h"

namespace heightlight {
namespace {

constexpr float kHalfPi = std::numbers::pi_v<float> / 2;

/// What a slice sends from above slope m, in the plane of its azimuth; sky_walk.h has the derivation. The
/// difference of two such sums is what lies between their slopes.
struct SliceSums {
  float sky = 0, solid = 0;
  float along = 0, up = 0;             ///< if wanted.first
  float along_squared = 0, mixed = 0;  ///< if wanted.second
};

SliceSums integrate_slice(float c, float n_z, float m, const SkyWanted& wanted) {
  const float q = 1 / (1 + m * m);
  const float zenith = kHalfPi - std::atan(m) - m * q;
  const float s = m * std::sqrt(q);
  SliceSums slice;
  slice.sky = c * zenith + n_z * q;
  slice.solid = 1 - s;
  if (wanted.first) {
    const float e = 1 - s;
    const float mixed = q * std::sqrt(q);
    slice.along = 2.0F / 3 * (c * (e * e * (2 + s)) + n_z * mixed);
    slice.up = 2.0F / 3 * (c * mixed + n_z * (e * (1 + s + s * s)));
  }
  if (wanted.second) {
    const float fourth = q * q / 4;
    slice.along_squared = 2 * (c * (0.375F * zenith - m * fourth) + n_z * fourth);
    slice.mixed = 2 * (c * fourth + n_z * (zenith / 8 + m * fourth));
  }
  return slice;
}

SliceSums operator-(const SliceSums& a, const SliceSums& b) {
  return {
      a.sky - b.sky,    a.solid - b.solid, a.along - b.along, a.up - b.up, a.along_squared - b.along_squared,
      a.mixed - b.mixed};
}

void add(float share, const SliceSums& slice, SliceSums& sum) {
  sum.sky += share * slice.sky;
  sum.solid += share * slice.solid;
  sum.along += share * slice.along;
  sum.up += share * slice.up;
  sum.along_squared += share * slice.along_squared;
  sum.mixed += share * slice.mixed;
}

/// The slope halfway between two slopes, by angle.
float slope_between(float a, float b) {
  const float cosine_a = 1 / std::sqrt(1 + a * a);
  const float cosine_b = 1 / std::sqrt(1 + b * b);
  return (a * cosine_a + b * cosine_b) / (cosine_a + cosine_b);
}

/// μ of a falloff at a share in [0, 1] of the maximum distance.
float openness(Falloff falloff, float share) {
  if (falloff == Falloff::root) return std::sqrt(share);
  return falloff == Falloff::exponential ? exponential_openness(share, 1.0F) : share;
}

/// Mean of μ over a stretch from `begin` to `end`, seen from slope m to `seen`. It is the mean of μ at a
/// quarter and three quarters of the angle between them, weighted by what these directions add to the
/// irradiance.
float share_of_stretch(const ProfilePoint& begin, const ProfilePoint& end, float c, float n_z, float m,
                       float seen, const DistanceTable& maximum_distance) {
  if (begin.way == 0) return 0;  // the receiver's own facet: it is hit at once
  const float g = (end.rise - begin.rise) / run_between(begin.way, end.way);
  const float p = begin.rise - g * begin.way;
  const float middle = slope_between(m, seen);
  float weights = 1e-20F;
  float sum = 0;
  for (const float slope : {slope_between(m, middle), slope_between(middle, seen)}) {
    // The line p + g t is seen under that slope at t = meets.
    const float meets = slope < g ? -p / (g - slope) : begin.way;
    const float way =
        begin.rise <= maximum_distance.deepest ? end.way : std::clamp(meets, begin.way, end.way);
    const float squared = 1 + slope * slope;
    const float share = std::min(1.0F, way * std::sqrt(squared) / maximum_distance.distance);
    const float weight = std::max(0.0F, c + n_z * slope) / squared;
    weights += weight;
    sum += weight * openness(maximum_distance.falloff, share);
  }
  return sum / weights;
}

/// For a sharp maximum distance: the slopes between which a stretch lies inside its sphere. They are no less
/// than m and no more than `seen`, and equal where the stretch lies outside. The line p + g t meets the
/// sphere where (1 + g²) t² + 2 p g t + p² = D².
std::pair<float, float> slopes_inside(const ProfilePoint& begin, const ProfilePoint& end, float m, float seen,
                                      const DistanceTable& maximum_distance) {
  if (begin.way == 0) return {m, seen};
  // A stretch that begins in a hole is seen at its end.
  if (begin.rise <= maximum_distance.deepest)
    return {m, end.squared() <= maximum_distance.squared ? seen : m};
  const float g = (end.rise - begin.rise) / run_between(begin.way, end.way);
  const float p = begin.rise - g * begin.way;
  const float u = 1 + g * g;
  const float root = maximum_distance.squared * u - p * p;
  if (root <= 0) return {m, m};
  const float enters = (-std::sqrt(root) - p * g) / u;
  const float leaves = (std::sqrt(root) - p * g) / u;
  const float low = enters > begin.way ? p / enters + g : m;
  const float high = leaves < end.way ? p / std::max(leaves, begin.way) + g : seen;
  const float from = std::clamp(low, m, seen);
  return {from, std::clamp(high, from, seen)};
}

/// The sums of a receiver's slice with a maximum distance.
SliceSums slice_within(const WalkTile& tile, const AzimuthTable& azimuth,
                       const DistanceTable& maximum_distance, int i, int j, float c, float n_z, float lowest,
                       const SkyWanted& wanted) {
  SliceSums open;
  float m = lowest;
  SliceSums above = integrate_slice(c, n_z, m, wanted);
  ProfilePoint begin;
  const auto see = [&](const ProfilePoint& from, const ProfilePoint& to, float seen) {
    if (!(seen > m)) return;
    const SliceSums next = integrate_slice(c, n_z, seen, wanted);
    if (maximum_distance.falloff == Falloff::none) {
      const auto [low, high] = slopes_inside(from, to, m, seen, maximum_distance);
      add(1, above - integrate_slice(c, n_z, low, wanted), open);
      add(1, integrate_slice(c, n_z, high, wanted) - next, open);
    } else {
      add(share_of_stretch(from, to, c, n_z, m, seen, maximum_distance), above - next, open);
    }
    above = next;
    m = seen;
  };
  for (std::size_t k = 0; k < maximum_distance.near; ++k) {
    const NearSample& sample = azimuth.near[k];
    const float seen = near_slope(tile, azimuth, k, i, j);
    const float way = 1 / sample.per_distance;
    const ProfilePoint end{way, std::max(seen * way, maximum_distance.deepest)};
    see(begin, end, seen);
    begin = end;
  }
  for (std::size_t ring = 0; ring < maximum_distance.caps.size(); ++ring) {
    for (std::size_t k = 0; k < maximum_distance.caps[ring].size(); ++k) {
      const RingSample& sample = azimuth.rings[ring][k];
      const float seen = ring_slope(tile, sample, static_cast<int>(ring) + 1, i, j);
      const float way = 1 / sample.per_distance;
      const ProfilePoint end{way, std::max(seen * way, maximum_distance.deepest)};
      see(begin, end, seen);
      begin = end;
    }
  }
  add(1, above, open);
  return open;
}

/// Adds a receiver's slice to its sums.
void add_slice(const AzimuthTable& azimuth, std::size_t at, const SliceSums& slice, float full,
               SkySums& sums) {
  const float x = azimuth.world_x;
  const float y = azimuth.world_y;
  sums.sky[at] += slice.sky;
  sums.full[at] += full;
  sums.solid[at] += slice.solid;
  if (sums.wanted.first) {
    sums.first[0][at] += slice.along * x;
    sums.first[1][at] += slice.along * y;
    sums.first[2][at] += slice.up;
  }
  if (sums.wanted.second) {
    sums.second[0][at] += slice.along_squared * (x * x - y * y);
    sums.second[1][at] += slice.along_squared * (x * y);
    sums.second[2][at] += slice.sky - slice.along_squared;
    sums.second[3][at] += slice.mixed * x;
    sums.second[4][at] += slice.mixed * y;
  }
}

/// Calls slice_of(i, j, c, n_z, lowest) for every receiver that walks, and adds the slice that it returns.
/// Nothing below the slope `lowest` sends anything.
template <class SliceOf>
void for_receivers(const WalkTile& tile, const AzimuthTable& azimuth, SkySums& sums, SliceOf&& slice_of) {
  for (int i = 0; i < tile.rows; ++i) {
    for (int j = 0; j < tile.columns; ++j) {
      if (!sums.blocks[sky_block(i, j)]) continue;
      const auto at = static_cast<std::size_t>(i * WalkTile::kSide + j);
      const float tangent = tangent_slope(tile, azimuth, at);
      const float n_z = tile.normal_z[at];
      const float c = -n_z * tangent;
      const bool steep = n_z * n_z * (1 + sums.steep * sums.steep) < 1;
      const float full = steep ? integrate_slice(c, n_z, tangent, {}).sky : 1;
      const float lowest =
          sums.below == BelowHorizontal::ground ? std::max(tangent, level_slope(tile, azimuth, at)) : tangent;
      add_slice(azimuth, at, slice_of(i, j, c, n_z, lowest), full, sums);
    }
  }
}

/// Adds what lies above the slope that horizon(i, j, lowest) returns, for every receiver that walks.
template <class Horizon>
void add_above(const WalkTile& tile, const AzimuthTable& azimuth, SkySums& sums, Horizon&& horizon) {
  for_receivers(tile, azimuth, sums, [&](int i, int j, float c, float n_z, float lowest) {
    const float m = horizon(i, j, lowest);
    if (sums.keep_slope) sums.slope[static_cast<std::size_t>(i * WalkTile::kSide + j)] = m;
    return integrate_slice(c, n_z, m, sums.wanted);
  });
}

}  // namespace

void SkySums::clear() {
  for (Values* sums : {&sky, &full, &solid}) sums->fill(0);
  if (wanted.first) first.fill({});
  if (wanted.second) second.fill({});
  blocks.set();
}

void walk_sky_scalar(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far, SkySums& sums) {
  add_above(tile, azimuth, sums,
            [&](int i, int j, float lowest) { return horizon_slope(tile, azimuth, far, i, j, lowest); });
}

void walk_sky_within_scalar(const WalkTile& tile, const AzimuthTable& azimuth,
                            const DistanceTable& maximum_distance, SkySums& sums) {
  if (sums.keep_slope) {
    add_above(tile, azimuth, sums, [&](int i, int j, float lowest) {
      return horizon_slope_within(tile, azimuth, maximum_distance, i, j, lowest);
    });
    return;
  }
  for_receivers(tile, azimuth, sums, [&](int i, int j, float c, float n_z, float lowest) {
    return slice_within(tile, azimuth, maximum_distance, i, j, c, n_z, lowest, sums.wanted);
  });
}

}  // namespace heightlight
