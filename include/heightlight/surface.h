#pragma once

#include <memory>

#include "heightlight/heightmap.h"

namespace heightlight {

struct Surroundings;

/// The triangulated surface that every method shares. Samples are vertices; each cell is cut from (row i,
/// column j) to (i+1, j+1). A cell is named by its upper left vertex; under `tile` the last row and column
/// have cells that wrap.
///
/// World axes: x right, y up the image, z out of it. Grid coordinates: u = column, v = row (downwards), in
/// texels.
struct Surface {
  Heightmap map;
  Image<Vector3> normal;  ///< unit, z > 0; NaN where the sample is missing
  float highest = 0;      ///< of map.height, or of the whole map that it is a window of
  float lowest = 0;
  /// What lies around a window of a larger map; null: the surface is the whole map.
  std::shared_ptr<const Surroundings> around = {};

  int width() const { return map.height.width; }
  int height() const { return map.height.height; }
  bool tiles() const { return map.boundary == Boundary::tile; }
  int cell_columns() const { return tiles() ? width() : width() - 1; }
  int cell_rows() const { return tiles() ? height() : height() - 1; }
};

/// Builds the surface. Normals are those of the central-difference gradient: wrapped when tiling, one-sided
/// at open edges and beside missing samples, level where a sample has no neighbour along an axis. Heights are
/// not changed. Throws UsageError for heights that are no rectangle or infinite, and for a spacing that is
/// not positive.
Surface build_surface(Heightmap map);

}  // namespace heightlight
