#pragma once

#include <cmath>
#include <vector>

#include "heightlight/screenspace.h"

// Combines what the spatial noise distributes over neighbours (Jimenez et al. 2016, section 4.3, Umenhoffer
// et al. 2009, section 4.2): the mean, with equal weights, of those results in a window of 4 × 4 texels that
// belong to the same surface. Any such window contains every rank of the noise once. It extends from one
// texel before to two texels after the receiver, so that its middle is half a texel off, as in every 4 × 4
// window.
//
// A neighbour belongs to the same surface if it lies within a tolerance of the receiver's tangent plane and
// its normal is similar to the receiver's.

namespace heightlight {

constexpr int kGatherBefore = 1;
constexpr int kGatherAfter = 2;

/// Distance from the tangent plane up to which neighbours count, in texels.
constexpr double kGatherTolerance = 0.3;

/// Least cosine between the normals at which neighbours count.
constexpr float kGatherCosine = 0.9F;

/// A texel near a receiver, and its offset from there: world units, y up.
struct NeighbourPlace {
  int row = 0;
  int column = 0;
  float x = 0;
  float y = 0;
};

/// How close to the receiver's tangent plane a neighbour must lie, and how similar its normal must be.
struct SurfaceTolerance {
  float distance = 0;  ///< world units
  float cosine = kGatherCosine;
};

/// Whether a neighbour belongs to the receiver's surface; never where its sample is missing.
inline bool on_same_surface(const DepthBuffer& depth, int row, int column, const NeighbourPlace& place,
                            const SurfaceTolerance& tolerance) {
  const float plane = depth.row_slope_x(row, column) * place.x + depth.row_slope_y(row, column) * place.y;
  const float above = depth.row_height(place.row, place.column) - depth.row_height(row, column) - plane;
  const float cosine = depth.row_normal_z(row, column) * depth.row_normal_z(place.row, place.column) *
                       (depth.row_slope_x(row, column) * depth.row_slope_x(place.row, place.column) +
                        depth.row_slope_y(row, column) * depth.row_slope_y(place.row, place.column) + 1);
  return std::fabs(above) * depth.row_normal_z(row, column) <= tolerance.distance &&
         cosine >= tolerance.cosine;
}

/// What the receivers of a row gather from: one or more results per texel, all of the depth buffer's size.
struct GatherPass {
  const DepthBuffer& depth;
  const std::vector<Map>& results;
  float tolerance = 0;  ///< world units
  float cosine = kGatherCosine;
};

/// Writes the means of columns [begin, end) of a row; NaN where the sample is missing. The readable version.
void gather_row_scalar(const GatherPass& pass, int row, int begin, int end, std::vector<Map>& means);

/// As gather_row_scalar, for a whole row, vectorized over neighbouring texels. The results differ only by the
/// rounding of fused products.
void gather_row(const GatherPass& pass, int row, std::vector<Map>& means);

/// The means of all rows.
std::vector<Map> gather_bilaterally(const DepthBuffer& depth, const std::vector<Map>& results);

}  // namespace heightlight
