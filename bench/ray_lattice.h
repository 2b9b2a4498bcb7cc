#pragma once

#include <array>
#include <vector>

#include "visibility/hemisphere_directions.h"

namespace heightlight {

/// Density of the rays that find a sky view factor.
enum class RayDensity {
  cosine,      ///< as in the form factor, so that all rays weigh the same
  solid_angle  ///< uniform: rays weigh their cosine. What our rays do, since ambient occlusion needs it
};

constexpr std::size_t kLatticePadding = 16;

/// Unit directions about +z, and their weights in the sky view factor (sum 1). Filled up to a multiple of
/// kLatticePadding with directions that weigh nothing.
struct RayLattice {
  std::vector<float> x, y, z, weight;
};

/// The lattices of `directions`, one per table, with the density wanted. Neighbours in them are neighbours on
/// the hemisphere, by eights, which is what a tracer of packets wants; one of streams does not mind.
std::array<RayLattice, HemisphereDirections::kTables> make_ray_lattices(
    const HemisphereDirections& directions, RayDensity density);

}  // namespace heightlight
