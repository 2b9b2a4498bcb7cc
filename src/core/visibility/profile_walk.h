#pragma once

#include <limits>
#include <vector>

#include "heightlight/visibility.h"
#include "visibility/ray_traversal.h"

// What a receiver sees along one azimuth, exactly. The profile of the surface above the azimuth's line is
// piecewise linear, with breakpoints where the line crosses a column, a row or a cell's diagonal. After s
// world units of way the line is at
//     u = u₀ + s g_u,   v = v₀ + s g_v,
// and a point of the profile that is h above the receiver is seen under the slope h/s. The receiver sees the
// points that are steeper than all before them. The walk goes outwards and keeps the steepest slope so far:
// every breakpoint that exceeds it ends a visible stretch of the segment before it. The horizon is the
// steepest slope of all.
//
// The position is kept as the numbers of columns and rows crossed, whole numbers counted from the receiver.
// Every breakpoint's way and height follow from these alone. So every step makes progress, whatever the
// rounding, and a map moved around its torus gives the same bits. A block of the maximum pyramid is skipped
// when its highest point is nowhere steeper than the slope so far. If a block's bound lets something pass,
// the bounds of the blocks around it let it pass, too: they are higher, over more way, and rounding is
// monotone. Which breakpoints are examined therefore depends on the cells' own bounds only, not on where the
// blocks lie.
//
// Holes, the receiver's own facet and the end of the map are treated as for rays (ray_traversal.h). A
// breakpoint counts where its facet has all its samples. The first breakpoint after a hole, if it is steeper
// than the slope so far, also stands for what is seen below it, down to that slope. A facet at the receiver
// that rises above the tangent plane is seen at its middle.

namespace heightlight {

/// Where a profile starts, and where it leads.
struct ProfileLine {
  int row = 0;
  int column = 0;
  double height = 0;  ///< height of the vertex
  double step_u = 0;  ///< g_u: columns per world unit of way
  double step_v = 0;  ///< g_v: rows (downwards) per world unit of way
  double maximum_distance =
      std::numeric_limits<double>::infinity();  ///< the profile ends after this way, world units
};

/// A visible stretch of the profile, straight and inside one facet; or one place that stands for what is
/// seen, whose begin and end are equal. It is seen from the slope at which the stretch before it ends. The
/// first stretch is seen from the least slope asked for.
struct VisibleStretch {
  double slope = 0;  ///< up to which it is seen: its end's, unless it is the receiver's own facet
  double begin_way = 0;
  double end_way = 0;
  SurfacePoint begin;
  SurfacePoint end;
};

/// Walks along the line and returns the horizon's slope (height per world unit of way), −∞ where there is no
/// surface. Appends what is seen above `least_slope` to `stretches`, in rising order; appends nothing where
/// the horizon is lower. Where the map tiles, the walk ends after as many columns or rows as kMostWraps tiles
/// have: what it leaves out lies within relief / way of the horizontal.
double walk_profile(const RayGrid& grid, const ProfileLine& line, double least_slope,
                    std::vector<VisibleStretch>& stretches);

}  // namespace heightlight
