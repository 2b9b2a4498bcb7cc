#pragma once

#include "heightlight/image.h"
#include "heightlight/surface.h"

namespace heightlight {

/// By what the rise of a cell is divided, though the ray passes beside its middle.
enum class CellDistance {
  along_ray,  ///< the way along the ray, as SAGA GIS does: diagonal neighbours are too near, and too steep
  to_cell     ///< the distance of the cell's middle, as CNES' rastertools does
};

/// How terrain tools look for a horizon.
struct MarchOptions {
  double azimuth_rad = 0;  ///< counterclockwise from x
  int cells = 0;           ///< steps; 0: as far as the map goes
  CellDistance distance = CellDistance::along_ray;
};

/// Slope of the steepest cell toward an azimuth, of every texel, by the usual algorithm: steps as long as a
/// cell's shorter side along the ray, and at each the height of the nearest cell. −∞ where the first step
/// leaves the map, NaN where the sample is missing; cells that are missing hide nothing. The map must be
/// open.
///
/// All texels of a row make the same step at a time, side by side in vectors, on all threads: so the time is
/// the algorithm's.
Map march_horizon(const Surface& surface, const MarchOptions& options);

}  // namespace heightlight
