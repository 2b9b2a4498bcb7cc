#include <algorithm>
#include <cmath>

#include "visibility/ray_traversal.h"

namespace heightlight {
namespace {

float clamp_unit(float value) { return std::min(std::max(value, 0.0F), 1.0F); }

float away_from_zero(float step) {
  return std::fabs(step) < kLeastStep ? std::copysign(kLeastStep, step) : step;
}

/// Heights of the four corners of a cell above the receiver, and the surface over the cell. Differences are
/// taken first, so that a large offset of the heights costs no digits.
struct Cell {
  float upper_left, upper_right, lower_left, lower_right;

  Cell(const RayGrid& grid, float z0, int row, int column) {
    const int right = column + 1 == grid.width ? 0 : column + 1;
    const int below = grid.tiles && row + 1 == grid.cell_rows ? 0 : row + 1;
    const float* upper = grid.height + static_cast<std::ptrdiff_t>(row) * grid.width;
    const float* lower = grid.height + static_cast<std::ptrdiff_t>(below) * grid.width;
    upper_left = upper[column] - z0;
    upper_right = upper[right] - z0;
    lower_left = lower[column] - z0;
    lower_right = lower[right] - z0;
  }

  float height_at(float across, float down) const {
    return across >= down
               ? upper_left + across * (upper_right - upper_left) + down * (lower_right - upper_right)
               : upper_left + down * (lower_left - upper_left) + across * (lower_right - lower_left);
  }

  float height_on_diagonal(float along) const { return upper_left + along * (lower_right - upper_left); }
};

struct Walker {
  const RayGrid& grid;
  float z0, step_u, step_v, slope, sky_way, per_u, per_v, per_diagonal;
  int origin_column, origin_row;  // the receiver, moved by whole tiles when the ray wraps
  int column, row, level = 0, wraps = 0;
  float s = 0;

  Walker(const RayGrid& g, const RayBundle& bundle, int ray)
      : grid(g),
        z0(bundle.height),
        step_u(away_from_zero(bundle.step_u[ray])),
        step_v(away_from_zero(bundle.step_v[ray])),
        slope(bundle.slope[ray]),
        sky_way(bundle.sky_way[ray]),
        per_u(1.0F / step_u),
        per_v(1.0F / step_v),
        per_diagonal(1.0F / (step_u - step_v)),
        origin_column(bundle.column),
        origin_row(bundle.row),
        column(step_u > 0 ? bundle.column : bundle.column - 1),
        row(step_v > 0 ? bundle.row : bundle.row - 1) {}

  /// Brings a cell index that has left the map back by a whole tile. Returns false where nothing lies beyond.
  bool wrap() {
    const bool outside = column < 0 || column >= grid.cell_columns || row < 0 || row >= grid.cell_rows;
    if (!outside) return true;
    if (!grid.tiles || ++wraps > kMostWraps) return false;
    const int columns = grid.cell_columns;
    const int rows = grid.cell_rows;
    const int tiles_u = column < 0 ? 1 : column >= columns ? -1 : 0;
    const int tiles_v = row < 0 ? 1 : row >= rows ? -1 : 0;
    column += tiles_u * columns;
    row += tiles_v * rows;
    origin_column += tiles_u * columns;
    origin_row += tiles_v * rows;
    return true;
  }

  /// Height of the ray above the receiver.
  float rise_at(float way) const { return way * slope; }

  /// Is the ray below the surface where it enters the cell (out of a hole), at the cell's diagonal, or where
  /// it leaves the cell? If so, sets the place.
  bool blocked_in_cell(float s_exit, float& across, float& down) const {
    const Cell cell(grid, z0, row, column);
    const float left = static_cast<float>(column - origin_column);
    const float top = static_cast<float>(row - origin_row);
    const auto u_at = [&](float way) { return clamp_unit(way * step_u - left); };
    const auto v_at = [&](float way) { return clamp_unit(way * step_v - top); };

    float s_before = s;
    float d_before = cell.height_at(u_at(s), v_at(s)) - rise_at(s);
    if (s > 0 && d_before > 0) {
      across = u_at(s);
      down = v_at(s);
      return true;
    }
    const float s_diagonal = (left - top) * per_diagonal;
    float s_after = s_exit;
    float d_after = cell.height_at(u_at(s_exit), v_at(s_exit)) - rise_at(s_exit);
    if (s_diagonal > s && s_diagonal < s_exit) {
      const float d_diagonal = cell.height_on_diagonal(u_at(s_diagonal)) - rise_at(s_diagonal);
      if (d_diagonal > 0) {
        s_after = s_diagonal;
        d_after = d_diagonal;
      } else {
        s_before = s_diagonal;
        d_before = d_diagonal;
      }
    }
    if (!(d_after > 0)) return false;
    if (s_before == 0) {  // the receiver's own facet
      const bool upper_right = u_at(0.5F * s_after) >= v_at(0.5F * s_after);
      across = upper_right ? kTwoThirds : kOneThird;
      down = upper_right ? kOneThird : kTwoThirds;
      return true;
    }
    // d is linear between d_before ≤ 0 and d_after > 0. If the earlier breakpoint is in a hole, the hit is at
    // the later one.
    const float share = d_before <= 0 ? d_before / (d_before - d_after) : 1.0F;
    const float s_hit = s_before + share * (s_after - s_before);
    across = u_at(s_hit);
    down = v_at(s_hit);
    return true;
  }

  /// Walks to the first place where the ray is blocked. Returns its cell, or kSky where there is none.
  std::int32_t walk(float& across, float& down) {
    if (!wrap()) return kSky;
    for (;;) {
      const int mask = ~((1 << level) - 1);
      const int left = column & mask;
      const int top = row & mask;
      const int right = std::min(left + (1 << level), grid.cell_columns);
      const int bottom = std::min(top + (1 << level), grid.cell_rows);
      const int border_u = step_u > 0 ? right : left;
      const int border_v = step_v > 0 ? bottom : top;
      const float s_u = static_cast<float>(border_u - origin_column) * per_u;
      const float s_v = static_cast<float>(border_v - origin_row) * per_v;
      const float s_exit = std::max(s, std::min(s_u, s_v));
      const float lowest = rise_at(slope < 0 ? s_exit : s);

      if (s >= sky_way) return kSky;
      const std::int32_t block = grid.pyramid->index(level, row, column);
      if (lowest < grid.pyramid->highest[static_cast<std::size_t>(block)] - z0) {
        if (level > 0) {
          --level;
          continue;
        }
        if (blocked_in_cell(s_exit, across, down)) return row * grid.width + column;
      }

      const bool crosses_u = s_u <= s_v;
      if (crosses_u) {
        column = step_u > 0 ? right : left - 1;
        row = std::clamp(origin_row + static_cast<int>(std::floor(s_exit * step_v)), top, bottom - 1);
      } else {
        row = step_v > 0 ? bottom : top - 1;
        column = std::clamp(origin_column + static_cast<int>(std::floor(s_exit * step_u)), left, right - 1);
      }
      const int border = crosses_u ? border_u : border_v;
      const int parent_mask = (2 << level) - 1;
      const bool leaves_parent =
          (border & parent_mask) == 0 || border == (crosses_u ? grid.cell_columns : grid.cell_rows);
      if (leaves_parent && level + 1 < grid.pyramid->levels) ++level;
      s = s_exit;
      if (!wrap()) return kSky;
    }
  }
};

}  // namespace

RayGrid make_ray_grid(const Surface& surface, const MaximumPyramid& pyramid) {
  RayGrid grid;
  grid.height = surface.map.height.values.data();
  grid.width = surface.width();
  grid.cell_columns = surface.cell_columns();
  grid.cell_rows = surface.cell_rows();
  grid.tiles = surface.tiles();
  grid.highest = surface.highest;
  grid.pyramid = &pyramid;
  return grid;
}

void traverse_scalar(const RayGrid& grid, const RayBundle& bundle, const RayEnds& ends) {
  for (int ray = 0; ray < bundle.count; ++ray) {
    ends.cell[ray] = Walker(grid, bundle, ray).walk(ends.across[ray], ends.down[ray]);
  }
}

}  // namespace heightlight
