#pragma once

#include "visibility/distance_table.h"
#include "visibility/far_view.h"

// What scalar walks see from one receiver at a time: the one in row i and column j of a tile, with the index
// `at`. All slopes are along the azimuth, in the axes of the map.

namespace heightlight {

/// Slope of the tangent plane, on which the normal stands.
inline float tangent_slope(const ReceiverTile& tile, const AzimuthTable& azimuth, std::size_t at) {
  return tile.slope_x[at] * azimuth.world_x + tile.slope_y[at] * azimuth.world_y;
}

/// Slope of what is level at the receiver.
inline float level_slope(const ReceiverTile& tile, const AzimuthTable& azimuth, std::size_t at) {
  return tile.level_x[at] * azimuth.world_x + tile.level_y[at] * azimuth.world_y;
}

/// Slope under which near sample k is seen.
float near_slope(const WalkTile& tile, const AzimuthTable& azimuth, std::size_t k, int i, int j);

/// Slope under which a sample of a ring is seen.
float ring_slope(const WalkTile& tile, const RingSample& sample, int ring, int i, int j);

/// Slope of the horizon, at least `least`.
float horizon_slope(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far, int i, int j,
                    float least);

/// Slope of the horizon that the surface within the maximum distance makes, at least `least`.
float horizon_slope_within(const WalkTile& tile, const AzimuthTable& azimuth,
                           const DistanceTable& maximum_distance, int i, int j, float least);

/// A point of the profile: its way and its height above the receiver, world units.
struct ProfilePoint {
  float way = 0;
  float rise = 0;

  float squared() const { return rise * rise + way * way; }
};

}  // namespace heightlight
