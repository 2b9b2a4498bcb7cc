#pragma once

#include "visibility/surroundings.h"

namespace heightlight {

/// A map cut into square windows, row by row from its upper left corner; those at its other edges may be
/// smaller.
struct WindowGrid {
  int map_width = 0;
  int map_height = 0;
  int side = 0;  ///< texels, a multiple of kTileSide

  int across() const { return (map_width + side - 1) / side; }
  int down() const { return (map_height + side - 1) / side; }
  int count() const { return across() * down(); }
  WindowPlace place(int window) const;
};

}  // namespace heightlight
