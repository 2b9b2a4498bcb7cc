#include "visibility/profile_walk.h"

#include <algorithm>
#include <cmath>

namespace heightlight {
namespace {

constexpr double kMostLines = 1 << 30;

/// A point of the profile; `rise` is NaN in a hole.
struct Breakpoint {
  double way = 0;
  double rise = 0;

  double slope() const { return rise / way; }
};

double clamp_unit(double value) { return std::min(std::max(value, 0.0), 1.0); }

/// Heights of the four corners of a cell above the receiver.
struct Cell {
  double upper_left, upper_right, lower_left, lower_right;

  Cell(const RayGrid& grid, double height, int row, int column) {
    const int right = column + 1 == grid.width ? 0 : column + 1;
    const int below = grid.tiles && row + 1 == grid.cell_rows ? 0 : row + 1;
    if (grid.ground) {
      upper_left = double{grid.ground->height(row, column)} - height;
      upper_right = double{grid.ground->height(row, right)} - height;
      lower_left = double{grid.ground->height(below, column)} - height;
      lower_right = double{grid.ground->height(below, right)} - height;
      return;
    }
    const float* upper = grid.height + static_cast<std::ptrdiff_t>(row) * grid.width;
    const float* lower = grid.height + static_cast<std::ptrdiff_t>(below) * grid.width;
    upper_left = double{upper[column]} - height;
    upper_right = double{upper[right]} - height;
    lower_left = double{lower[column]} - height;
    lower_right = double{lower[right]} - height;
  }

  /// Height on the diagonal; NaN where one of its ends is missing.
  double rise_on_diagonal(double across) const { return upper_left + across * (lower_right - upper_left); }

  /// Is one of the facet's samples missing?
  bool is_hole(bool upper_right_facet) const {
    return std::isnan(upper_left + lower_right + (upper_right_facet ? upper_right : lower_left));
  }
};

/// A side of a cell: it lies on a column's or a row's line, the one with the larger index (right, lower) or
/// the smaller. The right and upper sides belong to the upper right facet.
struct Side {
  bool of_column;
  bool larger;

  bool is_upper_right() const { return of_column == larger; }

  double rise(const Cell& cell, double along) const {
    if (cell.is_hole(is_upper_right())) return std::numeric_limits<double>::quiet_NaN();
    const double from = larger ? (of_column ? cell.upper_right : cell.lower_left) : cell.upper_left;
    const double to = larger ? cell.lower_right : (of_column ? cell.lower_left : cell.upper_right);
    return from + along * (to - from);
  }
};

/// Progress along one axis. Lines are the columns (or rows), counted from the receiver, which stands on line
/// 0.
struct Axis {
  double speed;     // |g|, lines per world unit of way
  double per_line;  // way from line to line; ∞ where the profile runs along one
  bool rising;      // towards larger indices
  int cells;        // number of cells of the map
  int origin;       // the receiver's line, moved by whole tiles when the profile wraps
  int cell;         // index of the cell where the profile is
  int crossed = 0;  // number of lines crossed

  Axis(double step, int start, int cell_count)
      : speed(std::fabs(step)),
        per_line(1 / speed),
        // A profile along a line runs on the side where the map has cells.
        rising(step > 0 || (step == 0 && start < cell_count)),
        cells(cell_count),
        origin(start),
        cell(rising ? start : start - 1) {}

  /// The line by which the walk leaves a block of 2^level cells.
  int exit_line(int level) const {
    const int first = cell & ~((1 << level) - 1);
    return rising ? std::min(first + (1 << level), cells) - origin : origin - first;
  }

  double way_to(int line) const { return line * per_line; }

  /// The profile's place in the present cell after some way, as the cell's own coordinate in [0, 1].
  double coordinate(double way) const {
    const double covered = clamp_unit(way * speed - crossed);
    return rising ? covered : 1 - covered;
  }

  void set_crossed(int lines) {
    crossed = lines;
    cell = rising ? origin + lines : origin - 1 - lines;
  }

  /// Counts the lines crossed after some way. `including` says whether a line that is just reached counts.
  void follow(double way, bool including) {
    int lines = std::max(crossed, static_cast<int>(way * speed));
    const auto is_behind = [&](int line) { return including ? way_to(line) <= way : way_to(line) < way; };
    while (is_behind(lines + 1)) ++lines;
    while (lines > crossed && !is_behind(lines)) --lines;
    set_crossed(lines);
  }

  /// Does the walk also leave the block's parent when it leaves the block by that line?
  bool leaves_parent(int line, int level) const {
    const int border = rising ? origin + line : origin - line;
    return (border & ((2 << level) - 1)) == 0 || border == cells;
  }

  bool is_on_map() const { return cell >= 0 && cell < cells; }

  /// Brings a cell index that has left the map back by a whole tile.
  void wrap() {
    if (is_on_map()) return;
    const int tile = cell < 0 ? cells : -cells;
    cell += tile;
    origin += tile;
  }

  /// Way across kMostWraps tiles, limited by the number of lines that can be counted.
  double way_across_tiles() const { return std::min(double{kMostWraps} * cells, kMostLines) / speed; }
};

class Walk {
 public:
  Walk(const RayGrid& grid, const ProfileLine& line, double least_slope, std::vector<VisibleStretch>& seen)
      : grid_(grid),
        height_(line.height),
        maximum_distance_(line.maximum_distance),
        least_slope_(least_slope),
        per_diagonal_(1 / (line.step_u - line.step_v)),
        seen_(seen),
        u_(line.step_u, line.column, grid.cell_columns),
        v_(line.step_v, line.row, grid.cell_rows) {
    if (grid.tiles)
      maximum_distance_ = std::min({maximum_distance_, u_.way_across_tiles(), v_.way_across_tiles()});
  }

  double horizon() {
    const double above = double{grid_.highest} - height_;
    int level = 0;
    while (stay_on_map() && way_ < maximum_distance_ && !(above <= slope_ * way_)) {
      const int line_u = u_.exit_line(level);
      const int line_v = v_.exit_line(level);
      const bool by_column = u_.way_to(line_u) <= v_.way_to(line_v);
      const double exit = by_column ? u_.way_to(line_u) : v_.way_to(line_v);
      // Below the pyramid's first level, the blocks of that level bound their parts, too.
      const int bounding = std::max(level, grid_.first_level);
      const std::int32_t block = grid_.pyramid->index(bounding, v_.cell, u_.cell);
      const double highest = double{grid_.pyramid->highest[static_cast<std::size_t>(block)]} - height_;
      if (!(highest <= slope_ * (slope_ < 0 ? exit : way_))) {
        if (level > 0) {
          --level;
          continue;
        }
        look_at_cell({by_column, by_column ? u_.rising : v_.rising}, exit);
      }
      const bool climbs = by_column ? u_.leaves_parent(line_u, level) : v_.leaves_parent(line_v, level);
      if (climbs && level + 1 < grid_.pyramid->levels) ++level;
      advance(by_column, by_column ? line_u : line_v, exit);
    }
    return slope_;
  }

 private:
  bool stay_on_map() {
    if (grid_.tiles) {
      u_.wrap();
      v_.wrap();
    }
    return u_.is_on_map() && v_.is_on_map();
  }

  /// Where a column and a row are reached at once, the column counts as crossed first.
  void advance(bool by_column, int line, double exit) {
    way_ = exit;
    entry_ = {by_column, by_column ? !u_.rising : !v_.rising};
    if (by_column) {
      u_.set_crossed(line);
      v_.follow(exit, false);
    } else {
      v_.set_crossed(line);
      u_.follow(exit, true);
    }
  }

  double rise_on(const Cell& cell, const Side& side, double way) const {
    return side.rise(cell, side.of_column ? v_.coordinate(way) : u_.coordinate(way));
  }

  /// Looks at the cell's breakpoints: where the cell is entered, its diagonal, and where it is left.
  void look_at_cell(const Side& exit_side, double exit) {
    const Cell cell(grid_, height_, v_.cell, u_.cell);
    const bool at_receiver = way_ == 0;
    // From the vertex, the profile runs into the facet by which it also leaves the cell, unless the diagonal
    // is in between.
    const bool same_sense = u_.rising == v_.rising;
    const bool starts_upper_right =
        at_receiver ? (same_sense ? exit_side.is_upper_right() : !u_.rising) : entry_.is_upper_right();
    Breakpoint before{way_, at_receiver ? 0.0 : rise_on(cell, entry_, way_)};
    if (at_receiver && cell.is_hole(starts_upper_right))
      before.rise = std::numeric_limits<double>::quiet_NaN();
    if (!at_receiver) look_at_hole_edge(before);
    if (starts_upper_right != exit_side.is_upper_right()) {
      const int offset = (u_.cell - u_.origin) - (v_.cell - v_.origin);
      const double way = std::clamp(offset * per_diagonal_, way_, exit);
      const Breakpoint diagonal{way, cell.rise_on_diagonal(u_.coordinate(way))};
      look_at_segment(before, diagonal, starts_upper_right);
      before = diagonal;
    }
    look_at_segment(before, {exit, rise_on(cell, exit_side, exit)}, exit_side.is_upper_right());
  }

  /// A breakpoint that comes out of a hole and is in sight is seen down to the slope so far.
  void look_at_hole_edge(const Breakpoint& point) {
    if (point.slope() > slope_)
      see(point.slope(), point.way, point.way, place_at(point.way), place_at(point.way));
  }

  void look_at_segment(const Breakpoint& before, Breakpoint after, bool upper_right) {
    if (before.way >= maximum_distance_) return;
    if (after.way > maximum_distance_) {
      after.rise = before.rise +
                   (after.rise - before.rise) * ((maximum_distance_ - before.way) / (after.way - before.way));
      after.way = maximum_distance_;
    }
    if (!(after.slope() > slope_)) return;
    if (std::isnan(before.rise)) return look_at_hole_edge(after);
    if (before.way == 0) {
      const SurfacePoint middle = upper_right ? place(kTwoThirds, kOneThird) : place(kOneThird, kTwoThirds);
      return see(after.slope(), after.way, after.way, middle, middle);
    }
    // The visible part begins where the segment rises above both the steepest slope so far and the least
    // slope asked for: there, d turns positive.
    const double least = std::max(slope_, least_slope_);
    const double d_before = std::min(before.rise - least * before.way, 0.0);
    const double d_after = after.rise - least * after.way;
    const double hidden = d_after > 0 ? d_before / (d_before - d_after) : 1.0;
    const double begin = before.way + hidden * (after.way - before.way);
    see(after.slope(), begin, after.way, place_at(begin), place_at(after.way));
  }

  SurfacePoint place(double across, double down) const {
    const std::uint32_t cell = static_cast<std::uint32_t>(v_.cell) * static_cast<std::uint32_t>(grid_.width) +
                               static_cast<std::uint32_t>(u_.cell);
    return {cell, static_cast<float>(across), static_cast<float>(down)};
  }

  SurfacePoint place_at(double way) const { return place(u_.coordinate(way), v_.coordinate(way)); }

  void see(double slope, double begin_way, double end_way, const SurfacePoint& begin,
           const SurfacePoint& end) {
    slope_ = slope;
    if (slope > least_slope_) seen_.push_back({slope, begin_way, end_way, begin, end});
  }

  const RayGrid& grid_;
  double height_, maximum_distance_, least_slope_, per_diagonal_;
  std::vector<VisibleStretch>& seen_;
  Axis u_, v_;
  Side entry_{};  // by which side the present cell was entered
  double way_ = 0;
  double slope_ = -std::numeric_limits<double>::infinity();  // the steepest so far
};

}  // namespace

double walk_profile(const RayGrid& grid, const ProfileLine& line, double least_slope,
                    std::vector<VisibleStretch>& stretches) {
  return Walk(grid, line, least_slope, stretches).horizon();
}

}  // namespace heightlight
