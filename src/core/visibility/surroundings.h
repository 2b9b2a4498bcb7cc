#pragma once

#include <vector>

#include "heightlight/surface.h"

namespace heightlight {

/// Where a window lies in a map. Its corner lies on the grid of the map's tiles (kTileSide), so that a
/// receiver is always walked together with the same receivers, whatever window it is in.
struct WindowPlace {
  int map_width = 0;  ///< texels of the whole map
  int map_height = 0;
  int first_row = 0;  ///< first row of the window in the map, a multiple of kTileSide
  int first_column = 0;
  int width = 0;
  int height = 0;

  friend bool operator==(const WindowPlace&, const WindowPlace&) = default;
};

/// The blocks at level l of the map that any texel of a window lies in, and `margin` more blocks on all
/// sides.
struct WindowBlocks {
  int first_row = 0;  ///< in blocks of the map; the numbering continues beyond the map's edges
  int first_column = 0;
  int width = 0;
  int height = 0;
};

WindowBlocks window_blocks(const WindowPlace& place, int level, int margin);

/// The heights that walks from a window read. Every level that rings read holds the blocks of the whole map
/// as far as walks look. Blocks beyond the edges of a map that tiles are the blocks of its other side. Beyond
/// the edges of an open map there is nothing.
struct Surroundings {
  struct Level {
    WindowBlocks blocks;
    Image<float> mean;     ///< level 0: heights of the samples that occlude, NaN where missing and beyond an
                           ///< open map's edges; other levels: means as in HeightPyramid, kNoHeight there
    Image<float> highest;  ///< empty at level 0
  };

  WindowPlace place;
  int margin = 0;             ///< number of blocks around the window that every level holds
  std::vector<Level> levels;  ///< levels[l] is level l
};

/// Where a surface lies in its map: the surface is the whole map or a window of it.
WindowPlace place_in_map(const Surface& surface);

}  // namespace heightlight
