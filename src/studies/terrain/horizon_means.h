#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/stopwatch.h"
#include "heightlight/surface.h"
#include "heightlight/watch.h"
#include "terrain/horizon_march.h"
#include "terrain/terrain_skies.h"

namespace heightlight {

/// A definition over a whole map; NaN where the sample is missing.
struct DefinitionMap {
  TerrainSky definition = TerrainSky::sky_view_factor;
  Map map;
  Cost cost;  ///< of that definition alone: of all horizons, and of its own sums
};

/// Slopes of horizons of every texel toward each of some azimuths.
using HorizonFinder = std::function<std::vector<Map>(const std::vector<double>& azimuths_rad)>;

/// Definitions from horizons, which are found some azimuths at a time.
std::vector<DefinitionMap> sum_definitions(const Surface& surface, const std::vector<double>& azimuths_rad,
                                           const std::vector<TerrainSky>& definitions,
                                           const HorizonFinder& find_horizons);

/// Bytes per texel that finding so many definitions at once takes, the maps that are found included.
std::uint64_t definition_bytes_per_texel(std::size_t definitions);

/// By the usual algorithm, toward 2πk/K from the map's top clockwise. The azimuth of `march` is not used.
std::vector<DefinitionMap> march_definitions(const Surface& surface, int azimuths, MarchOptions march,
                                             const std::vector<TerrainSky>& definitions);

/// By horizon walks, toward 2π (k + ¼)/K. Their horizons are nowhere below the tangent plane, also for
/// definitions of a level receiver.
std::vector<DefinitionMap> walk_definitions(const Surface& surface, int azimuths,
                                            const std::vector<TerrainSky>& definitions,
                                            const Watch& watch = {});

}  // namespace heightlight
