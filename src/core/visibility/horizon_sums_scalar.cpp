#include "visibility/horizon_slope.h"
#include "visibility/horizon_sums.h"

namespace heightlight {
namespace {

/// Adds the terms of each receiver's horizon, whose slope horizon(i, j) returns.
template <class Horizon>
void add_terms(const WalkTile& tile, const AzimuthTable& azimuth, HorizonSums& sums, Horizon&& horizon) {
  for (int i = 0; i < tile.rows; ++i) {
    for (int j = 0; j < tile.columns; ++j) {
      const auto at = static_cast<std::size_t>(i * WalkTile::kSide + j);
      const float level = level_slope(tile, azimuth, at);
      const float tangent = tangent_slope(tile, azimuth, at) - level;
      const HorizonTerms<float> terms = horizon_terms(horizon(i, j) - level, tangent);
      for (std::size_t k = 0; k < kHorizonMeans; ++k) sums.of[k][at] += terms[k];
    }
  }
}

}  // namespace

void add_horizons_scalar(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far,
                         HorizonSums& sums) {
  add_terms(tile, azimuth, sums,
            [&](int i, int j) { return horizon_slope(tile, azimuth, far, i, j, kNoHeight); });
}

void add_horizons_within_scalar(const WalkTile& tile, const AzimuthTable& azimuth,
                                const DistanceTable& maximum_distance, HorizonSums& sums) {
  add_terms(tile, azimuth, sums, [&](int i, int j) {
    return horizon_slope_within(tile, azimuth, maximum_distance, i, j, kNoHeight);
  });
}

}  // namespace heightlight
