#pragma once

#include <array>

#include "visibility/ray_traversal.h"

// Beyond which way is a ray sure to be above the surface? A receiver's rays share the answer, so that it
// costs little to find and spares many of them the walk.
//
// At level l of the maximum pyramid, the receiver's block and its neighbours cover everything nearer than 2^l
// columns and rows. What they hold that is no nearer than 2^(l−1), where level l − 1 has it covered, is seen
// under a slope of at most max(D, 0) / 2^(l−1), D being their highest point above the receiver. (At level 0,
// a facet at the vertex is nowhere steeper than at its far edge, at least 1/√2 away.) A ray that is no
// flatter than the bounds of level l and all above it meets nothing any more once it is 2^(l−1) columns or
// rows away, which √2 · 2^(l−1) of way makes sure. A ray looks into one quadrant only, so that bounds are
// kept by quadrant.

namespace heightlight {

struct SlopeBounds {
  int levels = 0;  ///< entries in use below, falling slopes by rising ways
  std::array<float, MaximumPyramid::kMostLevels + 1> way{};  ///< texels
  /// [quadrant][level]: nothing of the quadrant that is farther than `way` is steeper. Quadrant 1 has rising
  /// columns, 2 rising rows, 3 both.
  std::array<std::array<float, MaximumPyramid::kMostLevels + 1>, 4> slope{};
};

/// Bounds for the receiver at a vertex of that height.
SlopeBounds bound_slopes(const RayGrid& grid, int row, int column, float height);

}  // namespace heightlight
