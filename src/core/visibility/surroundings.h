#pragma once

#include <vector>

#include "heightlight/surface.h"

namespace heightlight {

/// Where a window lies in a map. Its corner lies on the grid of the map's tiles (kTileSide), so that
/// receivers are walked in the same company whatever window they are in.
struct WindowPlace {
  int map_width = 0;  ///< texels of the whole map
  int map_height = 0;
  int first_row = 0;  ///< of the window, a multiple of kTileSide
  int first_column = 0;
  int width = 0;
  int height = 0;

  friend bool operator==(const WindowPlace&, const WindowPlace&) = default;
};

/// Blocks of a window, and of what is around it, at level l of the map: those that any of its texels lies in,
/// and `margin` more on all sides.
struct WindowBlocks {
  int first_row = 0;  ///< in blocks of the map; beyond its edges they go on
  int first_column = 0;
  int width = 0;
  int height = 0;
};

WindowBlocks window_blocks(const WindowPlace& place, int level, int margin);

/// The heights that walks from a window look at: of every level that rings look at, the blocks of the whole
/// map as far as walks look. Blocks beyond the edges of a map that tiles are those of its other side; of an
/// open map, nothing is there.
struct Surroundings {
  struct Level {
    WindowBlocks blocks;
    Image<float> mean;     ///< level 0: heights of what occludes, NaN where missing and beyond an open map's
                           ///< edges; other levels: kNoHeight there (HeightPyramid)
    Image<float> highest;  ///< empty at level 0
  };

  WindowPlace place;
  int margin = 0;             ///< blocks around the window that every level holds
  std::vector<Level> levels;  ///< [l]
};

/// Of the whole map, that a surface is or is a window of.
WindowPlace place_in_map(const Surface& surface);

}  // namespace heightlight
