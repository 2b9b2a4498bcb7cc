#pragma once

#include <cmath>
#include <vector>

#include "heightlight/screenspace.h"

// What the spatial noise takes apart, neighbours put together (Jimenez et al. 2016, section 4.3, Umenhoffer
// et al. 2009, section 4.2): the mean, with equal weights, of those results in a window of 4 × 4 texels that
// belong to the same surface. Any such window holds every rank of the noise once. It reaches from one texel
// before to two texels after the receiver: half a texel off its middle, as 4 × 4 windows are.
//
// A neighbour belongs to the same surface where it lies within a tolerance of the receiver's tangent plane,
// and its normal is like the receiver's.

namespace heightlight {

constexpr int kGatherBefore = 1;
constexpr int kGatherAfter = 2;

/// Distance from the tangent plane up to which neighbours count, in texels.
constexpr double kGatherTolerance = 0.3;

/// Cosine between normals from which on neighbours count.
constexpr float kGatherCosine = 0.9F;

/// A texel near a receiver, and where it lies from there: world units, y up.
struct NeighbourPlace {
  int row = 0;
  int column = 0;
  float x = 0;
  float y = 0;
};

/// How near to the receiver's tangent plane a neighbour must lie, and how like its normal must be.
struct SurfaceTolerance {
  float distance = 0;  ///< world units
  float cosine = kGatherCosine;
};

/// Whether a neighbour belongs to the receiver's surface; it does not where its sample is missing.
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

/// What a row's receivers gather from: one or more results per texel, all of the depth buffer's size.
struct GatherPass {
  const DepthBuffer& depth;
  const std::vector<Map>& results;
  float tolerance = 0;  ///< world units
  float cosine = kGatherCosine;
};

/// Writes the means of columns [begin, end) of a row; NaN where the sample is missing. The readable one.
void gather_row_scalar(const GatherPass& pass, int row, int begin, int end, std::vector<Map>& means);

/// Writes the means of a whole row; neighbouring texels side by side. The same, but for fused products.
void gather_row(const GatherPass& pass, int row, std::vector<Map>& means);

/// The means of all.
std::vector<Map> gather_bilaterally(const DepthBuffer& depth, const std::vector<Map>& results);

}  // namespace heightlight
