#pragma once

#include <array>
#include <vector>

#include "visibility/hemisphere_directions.h"

namespace heightlight {

/// Density of the rays that find a sky view factor.
enum class RayDensity {
  cosine,      ///< as in the form factor, so that all rays have equal weight
  solid_angle  ///< uniform: a ray's weight is its cosine. Our rays use it, as ambient occlusion needs it
};

constexpr std::size_t kLatticePadding = 16;

/// Unit directions about +z, and their weights in the sky view factor (sum 1). Padded to a multiple of
/// kLatticePadding with directions of weight 0.
struct RayLattice {
  std::vector<float> x, y, z, weight;
};

/// The lattices of `directions`, one per table, with the given density. Each group of eight successive
/// directions is close together on the hemisphere, which suits packets; for streams the order does not
/// matter.
std::array<RayLattice, HemisphereDirections::kTables> make_ray_lattices(
    const HemisphereDirections& directions, RayDensity density);

}  // namespace heightlight
