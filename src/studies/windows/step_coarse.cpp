#include <algorithm>
#include <cmath>
#include <limits>

#include "window/read_around.h"
#include "windows/steps.h"

namespace heightlight {
namespace {

/// Of blocks of cells, the highest sample that any of their cells has: what bounds lines of sight over them
/// (MaximumPyramid). −∞ where there is none.
Map highest_of_cells(const StoredMap& heights, Boundary boundary, const WindowPlace& place, int level) {
  const Map samples = read_around(heights, boundary,
                                  {place.first_row, place.first_column, place.height + 1, place.width + 1});
  const int side = 1 << level;
  Map blocks((place.width + side - 1) / side, (place.height + side - 1) / side,
             -std::numeric_limits<float>::infinity());
  for (int i = 0; i < blocks.height; ++i) {
    for (int j = 0; j < blocks.width; ++j) {
      float& highest = blocks(i, j);
      for (int row = i * side; row <= std::min((i + 1) * side, place.height); ++row) {
        for (int column = j * side; column <= std::min((j + 1) * side, place.width); ++column)
          highest = std::fmax(highest, samples(row, column));
      }
    }
  }
  return blocks;
}

}  // namespace

void find_coarse_blocks(const Work& work, int window) {
  const WorkFacts& facts = work.state.facts;
  const WindowFiles heights(heights_folder(work), 0);
  const WindowPlace place = facts.grid.place(window);
  const HeightPyramid::Level level = coarse_heights_of(heights, facts.boundary, place, facts.first_coarse);
  const Map cells = highest_of_cells(heights, facts.boundary, place, facts.first_coarse);
  write_window(coarse_folder(work), window, {&level.mean, &level.highest, &cells});
}

}  // namespace heightlight
