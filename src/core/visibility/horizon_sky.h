#pragma once

#include <optional>
#include <vector>

#include "heightlight/image.h"
#include "heightlight/visibility.h"
#include "heightlight/watch.h"
#include "visibility/height_pyramid.h"
#include "visibility/sky_walk.h"

namespace heightlight {

/// What every receiver sees of the sky, found by horizon walks; NaN where the sample is missing.
struct HorizonSky {
  Map ambient_occlusion;  ///< α, [0, 1]
  Map sky_view_factor;    ///< A, [0, 1]
  SkyMoments moments;     ///< only the moments that were wanted
};

/// What is found beside α and A, how far occluders count, and what lies below the horizontal.
struct SkyTask {
  SkyWanted wanted = {};
  std::optional<MaximumDistance> maximum_distance = {};  ///< absent: occluders count at any distance
  BelowHorizontal below = BelowHorizontal::sky;
};

/// RMS of 1 − A over the receivers of a tile's block that are present, from the sums so far; 0 where there is
/// none.
double surface_share(const WalkTile& tile, const SkySums& sums, std::size_t block);

HorizonSky walk_horizon_sky(const Surface& surface, const HeightPyramid& pyramid, const SkyPlan& plan,
                            const SkyTask& task = {}, const Watch& watch = {});

/// Bytes per texel of what walk_horizon_sky returns.
std::uint64_t horizon_sky_bytes(const SkyWanted& wanted);

/// Elevation of the horizon above what is level at the receiver (rad) toward each of `azimuths` (rad,
/// counterclockwise from x), at least the elevation of the tangent plane. Returns one map per azimuth, NaN
/// where the sample is missing. A maximum distance is taken to be sharp. The azimuths of `options` are not
/// used.
std::vector<Map> walk_horizons(const Surface& surface, const HeightPyramid& pyramid,
                               const WalkOptions& options, const std::vector<double>& azimuths,
                               const std::optional<MaximumDistance>& maximum_distance,
                               const Watch& watch = {});

}  // namespace heightlight
