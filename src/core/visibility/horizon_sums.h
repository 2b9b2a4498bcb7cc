#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "heightlight/visibility.h"
#include "visibility/distance_table.h"
#include "visibility/far_view.h"

// Means over azimuths of the functions of the horizon that terrain science uses (SkyDefinition). Walks start
// with no horizon at all, not at the tangent plane: the horizon stands where the surface has it.

namespace heightlight {

/// The function whose mean is taken. h is the horizon's elevation above what is level.
enum class HorizonMean {
  squared_cosine,  ///< cos² h, h ≥ 0
  one_less_sine,   ///< 1 − sin h, h ≥ 0
  cosine,          ///< cos h, h ≥ 0
  zenith_angle     ///< π/2 − h
};
constexpr std::size_t kHorizonMeans = 4;

/// One value per HorizonMean, in that order.
template <class T>
using HorizonTerms = std::array<T, kHorizonMeans>;

/// Slopes at or below this one mean that there is no surface. It is the slope of kNoHeight at the least
/// weight and the farthest distance.
constexpr float kNoSlope = -1e9F;

/// What one azimuth adds to a mean. The horizon is seen under `slope` and the tangent plane under `tangent`,
/// both above what is level. Where there is no horizon, zenith_angle takes the tangent plane, and the other
/// means take h = 0.
template <class T>
T horizon_term(HorizonMean mean, T slope, T tangent) {
  const T m = std::max(slope, T{0});
  const T q = 1 / (1 + m * m);
  switch (mean) {
    case HorizonMean::squared_cosine:
      return q;
    case HorizonMean::one_less_sine:
      return 1 - m * std::sqrt(q);
    case HorizonMean::cosine:
      return std::sqrt(q);
    default:
      return std::numbers::pi_v<T> / 2 - std::atan(slope > static_cast<T>(kNoSlope) ? slope : tangent);
  }
}

/// What one azimuth adds to each of the means.
template <class T>
HorizonTerms<T> horizon_terms(T slope, T tangent) {
  return {horizon_term(HorizonMean::squared_cosine, slope, tangent),
          horizon_term(HorizonMean::one_less_sine, slope, tangent),
          horizon_term(HorizonMean::cosine, slope, tangent),
          horizon_term(HorizonMean::zenith_angle, slope, tangent)};
}

/// Sums of horizon terms over the azimuths walked so far, per receiver of a tile.
struct HorizonSums {
  alignas(64) HorizonTerms<std::array<float, WalkTile::kTexels>> of{};
};

/// Walks one azimuth from every receiver of the tile. The readable implementation.
void add_horizons_scalar(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far,
                         HorizonSums& sums);

/// As add_horizons_scalar, but only occluders within a maximum distance count; it is taken to be sharp.
void add_horizons_within_scalar(const WalkTile& tile, const AzimuthTable& azimuth,
                                const DistanceTable& maximum_distance, HorizonSums& sums);

/// The fast implementations, with receivers side by side. Their sums agree as closely as those of sky walks
/// do (sky_walk.h).
void add_horizons(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far, HorizonSums& sums);
void add_horizons_within(const WalkTile& tile, const AzimuthTable& azimuth,
                         const DistanceTable& maximum_distance, HorizonSums& sums);

}  // namespace heightlight
