#include "visibility/surroundings.h"

namespace heightlight {

WindowBlocks window_blocks(const WindowPlace& place, int level, int margin) {
  WindowBlocks blocks;
  blocks.first_row = (place.first_row >> level) - margin;
  blocks.first_column = (place.first_column >> level) - margin;
  blocks.height = ((place.first_row + place.height - 1) >> level) + 1 + margin - blocks.first_row;
  blocks.width = ((place.first_column + place.width - 1) >> level) + 1 + margin - blocks.first_column;
  return blocks;
}

WindowPlace place_in_map(const Surface& surface) {
  if (surface.around) return surface.around->place;
  const int width = surface.width();
  const int height = surface.height();
  return {.map_width = width,
          .map_height = height,
          .first_row = 0,
          .first_column = 0,
          .width = width,
          .height = height};
}

}  // namespace heightlight
