#pragma once

#include <optional>
#include <vector>

#include "heightlight/watch.h"
#include "visibility/horizon_means.h"
#include "visibility/horizon_sky.h"

namespace heightlight {

/// The sky of every receiver by exact slices along `azimuths` azimuths, without links.
HorizonSky slice_sky(const Surface& surface, int azimuths, const SkyTask& task, const Watch& watch);

/// Elevations of exact horizons toward some azimuths, as walk_horizons gives them. A maximum distance is
/// taken to be sharp, and to lie on the map.
std::vector<Map> slice_horizons(const Surface& surface, const std::vector<double>& azimuths_rad,
                                const std::optional<MaximumDistance>& maximum_distance, const Watch& watch);

/// Means over `azimuths` exact horizons, as walk_horizon_means gives them.
std::vector<Map> slice_horizon_means(const Surface& surface, int azimuths,
                                     const std::vector<HorizonMean>& means,
                                     const std::optional<MaximumDistance>& maximum_distance,
                                     const Watch& watch);

/// The sky's shares of every receiver by rays, without links.
HorizonSky cast_sky(const Surface& surface, const RayOptions& rays, BelowHorizontal below,
                    const Watch& watch);

}  // namespace heightlight
