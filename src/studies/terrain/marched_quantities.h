#pragma once

#include <cstdint>
#include <vector>

#include "base/stopwatch.h"
#include "heightlight/surface.h"
#include "terrain/horizon_march.h"
#include "terrain/terrain_quantities.h"

namespace heightlight {

/// A quantity over a whole map; NaN where the sample is missing.
struct QuantityMap {
  TerrainQuantity quantity;
  Map map;
  Cost cost;  ///< of that quantity alone: of all horizons, and of its own sums
};

/// By the usual algorithm, toward so many azimuths from the map's top clockwise. The azimuth of `march` is
/// not used.
std::vector<QuantityMap> march_quantities(const Surface& surface, int azimuths, MarchOptions march,
                                          const std::vector<TerrainQuantity>& quantities);

/// Bytes per texel that marching for so many quantities at once takes, the maps that are found included.
std::uint64_t march_bytes_per_texel(std::size_t quantities);

}  // namespace heightlight
