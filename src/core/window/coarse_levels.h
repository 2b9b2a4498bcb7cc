#pragma once

#include <vector>

#include "heightlight/heightmap.h"
#include "visibility/height_pyramid.h"
#include "visibility/surroundings.h"
#include "window/stored_map.h"

// The levels of a map, or of a field on it, that are coarse enough to be held as a whole. Finer ones are made
// of samples, window by window.

namespace heightlight {

/// Levels of heights, as HeightPyramid has them.
struct CoarseHeights {
  int first = 0;                             ///< the finest of them, ≥ 1
  std::vector<HeightPyramid::Level> levels;  ///< [k] is level first + k; the last is one block
};

/// All of them, by the finest.
CoarseHeights complete_heights(int first, HeightPyramid::Level finest);

/// Levels of a field, as FieldPyramid has them, without holes.
struct CoarseField {
  int first = 0;
  std::vector<Map> levels;
};

/// All of them, by the finest, whose blocks are NaN where nothing is.
CoarseField complete_field(int first, Map finest);

/// Blocks of level `level` that the samples of a window make, which begins at whole blocks, and ends with
/// whole ones or with the map.
HeightPyramid::Level coarse_heights_of(const StoredMap& heights, Boundary boundary, const WindowPlace& place,
                                       int level);
Map coarse_field_of(Map field, int level);

/// What is there of the heights of a rectangle: NaN where a sample is missing or stands in nobody's way,
/// since it bounds no facet.
Map read_occluders(const StoredMap& heights, Boundary boundary, const MapRect& rect);

}  // namespace heightlight
