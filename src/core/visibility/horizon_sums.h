#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "heightlight/visibility.h"
#include "visibility/distance_table.h"
#include "visibility/far_view.h"

// Means over azimuths of what terrain science makes of a horizon (SkyDefinition). Walks start with no horizon
// at all, not at the tangent plane, so that it stands where the surface has it.

namespace heightlight {

/// Of what the means are, h the horizon's elevation above what is level.
enum class HorizonMean {
  squared_cosine,  ///< cos² h, h ≥ 0
  one_less_sine,   ///< 1 − sin h, h ≥ 0
  cosine,          ///< cos h, h ≥ 0
  zenith_angle     ///< π/2 − h
};
constexpr std::size_t kHorizonMeans = 4;

/// Per mean, in that order.
template <class T>
using HorizonTerms = std::array<T, kHorizonMeans>;

/// Slopes from here down are those of no surface: that of kNoHeight at the least weight and the farthest
/// distance.
constexpr float kNoSlope = -1e9F;

/// What one azimuth adds to a mean, of a horizon that is seen under `slope`, where the tangent plane is under
/// `tangent`, both above what is level: that plane stands for a horizon where there is none.
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

/// To each of the means.
template <class T>
HorizonTerms<T> horizon_terms(T slope, T tangent) {
  return {horizon_term(HorizonMean::squared_cosine, slope, tangent),
          horizon_term(HorizonMean::one_less_sine, slope, tangent),
          horizon_term(HorizonMean::cosine, slope, tangent),
          horizon_term(HorizonMean::zenith_angle, slope, tangent)};
}

/// Sums of these over the azimuths walked so far, per receiver of a tile.
struct HorizonSums {
  alignas(64) HorizonTerms<std::array<float, WalkTile::kTexels>> of{};
};

/// Walks one azimuth from every receiver of the tile. The readable one.
void add_horizons_scalar(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far,
                         HorizonSums& sums);

/// Likewise, with occluders only as far as a maximum distance, which is taken to be sharp.
void add_horizons_within_scalar(const WalkTile& tile, const AzimuthTable& azimuth,
                                const DistanceTable& maximum_distance, HorizonSums& sums);

/// The fast ones: receivers side by side. The same sums, as those of sky walks are.
void add_horizons(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far, HorizonSums& sums);
void add_horizons_within(const WalkTile& tile, const AzimuthTable& azimuth,
                         const DistanceTable& maximum_distance, HorizonSums& sums);

}  // namespace heightlight
