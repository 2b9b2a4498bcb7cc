#pragma once

#include <cstdint>

#include "heightlight/surface.h"
#include "surface/maximum_pyramid.h"

// Finds where a ray meets the surface, exactly: there are no fixed steps, and the start is not moved off the
// surface.
//
// A ray leaves the vertex (u₀, v₀) of height z₀ and runs over the grid. After s texels of way it is at
//     u = u₀ + s g_u,   v = v₀ + s g_v,   z = z₀ + s m,      g_u² + g_v² = 1,
// where m is its slope (height per texel of way, of either sign). Let d(s) be the height of the surface above
// the ray. Along a ray the surface is piecewise linear, with breakpoints where the ray crosses a column, a
// row or a cell's diagonal; so d is piecewise linear, too. The ray starts at d(0) = 0 and is blocked at the
// first breakpoint with d > 0. Between that breakpoint and the one before, the linear d gives the place.
// Because the test asks whether the ray is *below* the surface, rounding can delay a hit to the next
// breakpoint but never lets a ray through.
//
// A block of the maximum pyramid is skipped when the ray stays above the block's highest point. Otherwise the
// walk descends into the block, to the cell if need be. When it leaves a block by a border that its parent
// shares, it climbs one level. The position is kept as an integer cell, so that every step makes progress,
// whatever the rounding.
//
// The receiver stands for the surface around its vertex. A direction of its hemisphere that lies below a
// facet at the vertex is blocked at once. What it sees is that facet, and the facet's middle stands for it.
// (The vertex itself would do as well where the surface is smooth, but a receiver all of whose rays end so
// would then see nothing but itself.)
//
// Missing samples make d NaN, which is never > 0: holes occlude nothing. A ray that comes out of a hole below
// the surface is blocked by the hole's edge.

namespace heightlight {

/// Samples of a surface that is not in memory as a whole. Many threads may call its functions at once.
class StoredGround {
 public:
  virtual ~StoredGround() = default;
  /// Height of a sample of the map; NaN where it is missing.
  virtual float height(int row, int column) const = 0;
  /// Normal of a sample, as build_surface computes it.
  virtual Vector3 normal(int row, int column) const = 0;
};

/// The surface as the traversal reads it.
struct RayGrid {
  const float* height = nullptr;         ///< row-major, `width` per row
  const StoredGround* ground = nullptr;  ///< in place of `height`; for exact walks only
  int width = 0;
  int cell_columns = 0;
  int cell_rows = 0;
  bool tiles = false;
  float highest = 0;
  const MaximumPyramid* pyramid = nullptr;
  int first_level = 0;  ///< lowest level that the pyramid has; not 0 for exact walks only
};

RayGrid make_ray_grid(const Surface& surface, const MaximumPyramid& pyramid);

/// Rays from one vertex, as arrays of `count` entries padded to a multiple of kRayPadding.
struct RayBundle {
  int column = 0;
  int row = 0;
  float height = 0;
  int count = 0;
  const float* step_u = nullptr;  ///< g_u
  const float* step_v = nullptr;  ///< g_v
  const float* slope = nullptr;   ///< m
  const float* sky_way =
      nullptr;  ///< s from which on nothing is in the ray's path; 0 for rays that see the sky at once
};

/// Where each ray ended; arrays of `count` entries like the bundle's.
struct RayEnds {
  std::int32_t* cell = nullptr;  ///< upper left vertex of the cell that was hit, kSky where no cell was hit
  float* across = nullptr;       ///< place in the cell, in [0, 1]; unset for rays that reach the sky
  float* down = nullptr;
};

constexpr std::int32_t kSky = -1;
constexpr int kRayPadding = 16;

/// Coordinates of a triangle's middle in its cell.
constexpr float kOneThird = 1.0F / 3;
constexpr float kTwoThirds = 2.0F / 3;

/// Number of tiles that a ray may cross before it counts as having reached the sky. Only rays within relief /
/// (4096 × width) of the horizontal ever cross that many.
constexpr int kMostWraps = 4096;

/// |g_u| and |g_v| are kept at least this far from zero, which moves a ray by less than a float can resolve.
constexpr float kLeastStep = 1e-12F;

/// Follows the rays of the bundle one by one. The readable implementation.
void traverse_scalar(const RayGrid& grid, const RayBundle& bundle, const RayEnds& ends);

/// The fast implementation: as many rays side by side as the machine has lanes. When a ray is finished, the
/// next one takes its lane. The results are the same bit for bit.
void traverse(const RayGrid& grid, const RayBundle& bundle, const RayEnds& ends);

}  // namespace heightlight
