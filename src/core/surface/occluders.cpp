#include "surface/occluders.h"

#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace heightlight {
namespace {

/// Is there a sample at (row, column), which may lie one beyond the map's edges?
bool is_present(const Surface& surface, int row, int column) {
  const int rows = surface.height();
  const int columns = surface.width();
  if (surface.tiles()) {
    row = (row + rows) % rows;
    column = (column + columns) % columns;
  } else if (row < 0 || row >= rows || column < 0 || column >= columns) {
    return false;
  }
  return !std::isnan(surface.map.height(row, column));
}

/// Of the six facets around a vertex, is one whole?
bool bounds_facet(const Surface& surface, int row, int column) {
  // Its neighbours in the order of the facets between them: right, lower right, down, left, upper left, up.
  static constexpr int kAround[6][2] = {{0, 1}, {1, 1}, {1, 0}, {0, -1}, {-1, -1}, {-1, 0}};
  if (!is_present(surface, row, column)) return false;
  bool before = is_present(surface, row + kAround[5][0], column + kAround[5][1]);
  for (const auto& [down, right] : kAround) {
    const bool present = is_present(surface, row + down, column + right);
    if (before && present) return true;
    before = present;
  }
  return false;
}

}  // namespace

bool has_loose_samples(const Surface& surface) {
  return surface.cell_columns() == 0 || surface.cell_rows() == 0 || count_missing(surface.map) > 0;
}

Image<float> occluding_heights(const Surface& surface) {
  Image<float> heights(surface.width(), surface.height(), std::numeric_limits<float>::quiet_NaN());
  parallel_for(surface.height(), [&](std::int64_t line) {
    const int row = static_cast<int>(line);
    for (int column = 0; column < surface.width(); ++column) {
      if (bounds_facet(surface, row, column)) heights(row, column) = surface.map.height(row, column);
    }
  });
  return heights;
}

}  // namespace heightlight
