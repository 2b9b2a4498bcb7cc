#include "visibility/slope_bounds.h"

#include <algorithm>
#include <limits>

namespace heightlight {
namespace {

constexpr float kRounding = 1.000001F;  // bounds round up

/// Number of levels whose blocks, where the map tiles, fit into it a whole number of times; narrower blocks
/// at a seam would cover less than they should.
int aligned_levels(const RayGrid& grid) {
  if (!grid.tiles) return grid.pyramid->levels;
  int levels = 1;
  while (levels < grid.pyramid->levels && grid.cell_columns % (1 << levels) == 0 &&
         grid.cell_rows % (1 << levels) == 0) {
    ++levels;
  }
  return levels;
}

/// Highest point of the block that is `by_rows`, `by_columns` blocks away; −∞ beyond the end of the map.
float block_highest(const RayGrid& grid, int level, int row, int column, int by_rows, int by_columns) {
  int i = row + by_rows * (1 << level);
  int j = column + by_columns * (1 << level);
  if (grid.tiles) {
    i = (i + grid.cell_rows) % grid.cell_rows;
    j = (j + grid.cell_columns) % grid.cell_columns;
  } else if (i < 0 || j < 0 || i >= grid.cell_rows || j >= grid.cell_columns) {
    return -std::numeric_limits<float>::infinity();
  }
  return grid.pyramid->highest[static_cast<std::size_t>(grid.pyramid->index(level, i, j))];
}

/// Highest point of the blocks around the vertex, per quadrant. If a block begins at the vertex, no part of
/// it lies before the vertex.
std::array<float, 4> quadrants_highest(const RayGrid& grid, int level, int row, int column) {
  const int within = (1 << level) - 1;
  // The vertex's block is the block of the cell behind it, or on an open map's last line, of the cell before
  // it.
  const int cell_row = std::min(row, grid.cell_rows - 1);
  const int cell_column = std::min(column, grid.cell_columns - 1);
  const bool begins_row = (row & within) == 0 && cell_row == row;
  const bool begins_column = (column & within) == 0 && cell_column == column;
  std::array<float, 4> highest;
  highest.fill(-std::numeric_limits<float>::infinity());
  const int block_row = cell_row & ~within;
  const int block_column = cell_column & ~within;
  for (int di = -1; di <= 1; ++di) {
    for (int dj = -1; dj <= 1; ++dj) {
      const float value = block_highest(grid, level, block_row, block_column, di, dj);
      for (int quadrant = 0; quadrant < 4; ++quadrant) {
        const bool sees_column = (quadrant & 1) != 0 ? dj >= 0 : dj < 0 || (dj == 0 && !begins_column);
        const bool sees_row = (quadrant & 2) != 0 ? di >= 0 : di < 0 || (di == 0 && !begins_row);
        float& so_far = highest[static_cast<std::size_t>(quadrant)];
        if (sees_row && sees_column) so_far = std::max(so_far, value);
      }
    }
  }
  return highest;
}

}  // namespace

SlopeBounds bound_slopes(const RayGrid& grid, int row, int column, float height) {
  constexpr float kSqrt2 = 1.4142136F;
  SlopeBounds bounds;
  const int levels = aligned_levels(grid);
  bounds.levels = levels + 1;
  const auto slope_to = [height](float highest, float distance) {
    return std::max(highest - height, 0.0F) / distance * kRounding;
  };
  for (int level = 0; level < levels; ++level) {
    const auto l = static_cast<std::size_t>(level);
    const float distance = level == 0 ? 1 / kSqrt2 : 0.5F * static_cast<float>(1 << level);
    bounds.way[l] = level == 0 ? 0 : kSqrt2 * kRounding * distance;
    const std::array<float, 4> highest = quadrants_highest(grid, level, row, column);
    for (std::size_t q = 0; q < 4; ++q) bounds.slope[q][l] = slope_to(highest[q], distance);
  }
  // The last entry bounds what is beyond all levels, by the whole map's highest point.
  const auto last = static_cast<std::size_t>(levels);
  const float distance = static_cast<float>(1 << (levels - 1));
  bounds.way[last] = kSqrt2 * kRounding * distance;
  for (auto& slope : bounds.slope) {
    slope[last] = slope_to(grid.highest, distance);
    for (std::size_t l = last; l > 0; --l) slope[l - 1] = std::max(slope[l - 1], slope[l]);
  }
  return bounds;
}

}  // namespace heightlight
