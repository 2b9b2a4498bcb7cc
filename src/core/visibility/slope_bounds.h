#pragma once

#include <array>

#include "visibility/ray_traversal.h"

// Bounds that tell beyond which way a ray is sure to be above the surface. A receiver's rays share them, so
// that they cost little to find and spare many rays the walk.
//
// At level l of the maximum pyramid, the receiver's block and its neighbours cover everything nearer than 2^l
// columns and rows. Let D be the height of their highest point above the receiver. Level l − 1 covers what is
// nearer than 2^(l−1). The rest is seen under a slope of at most max(D, 0) / 2^(l−1). (At level 0, a facet at
// the vertex is nowhere steeper than at its far edge, which is at least 1/√2 away.) A ray that is no flatter
// than the bounds of level l and of all levels above meets nothing more once it is 2^(l−1) columns or rows
// away, which is certain after √2 · 2^(l−1) of way. A ray looks into one quadrant only, so bounds are kept
// per quadrant.

namespace heightlight {

struct SlopeBounds {
  int levels = 0;  ///< number of entries in use below; slopes fall as ways rise
  std::array<float, MaximumPyramid::kMostLevels + 1> way{};  ///< texels
  /// [quadrant][level]: nothing in the quadrant that is farther away than `way` is seen under a steeper
  /// slope. Quadrant 1 has rising columns, 2 rising rows, 3 both, 0 neither.
  std::array<std::array<float, MaximumPyramid::kMostLevels + 1>, 4> slope{};
};

/// Bounds for the receiver at the vertex (row, column), which has the given height.
SlopeBounds bound_slopes(const RayGrid& grid, int row, int column, float height);

}  // namespace heightlight
