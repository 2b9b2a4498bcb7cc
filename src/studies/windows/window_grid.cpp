#include "windows/window_grid.h"

#include <algorithm>

namespace heightlight {

WindowPlace WindowGrid::place(int window) const {
  const int row = window / across() * side;
  const int column = window % across() * side;
  return {.map_width = map_width,
          .map_height = map_height,
          .first_row = row,
          .first_column = column,
          .width = std::min(side, map_width - column),
          .height = std::min(side, map_height - row)};
}

}  // namespace heightlight
