#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace heightlight {

// Directions stratified in solid angle over a hemisphere: a spherical Fibonacci lattice. Direction k of N has
//     cosθ_k = 1 − (k + o)/N,   φ_k = 2π frac(k g) + r,   g = (√5 − 1)/2,
// each standing for the solid angle 2π/N. One lattice for every receiver would turn its error into a bias
// with a pattern, so each receiver has its own rotation r and one of kTables offsets o. There are so few
// offsets because with them cosθ_k, and with it a ray's form factor, depends on k and the table only: links
// need not store it.

/// One receiver's choice of lattice.
struct LatticeTurn {
  int table = 0;
  float cosine = 1;  ///< of r
  float sine = 0;
};

struct HemisphereDirections {
  static constexpr int kTables = 16;
  static constexpr int kTile = 64;  ///< turns repeat with this period in both axes

  int count = 0;
  std::uint64_t seed = 0;
  std::vector<float> azimuth_cosine;  ///< cos(2π frac(k g)), `count` of them
  std::vector<float> azimuth_sine;
  std::array<std::vector<float>, kTables> cosine;   ///< cosθ_k, falling with k
  std::array<std::vector<float>, kTables> sine;     ///< sinθ_k
  std::array<std::vector<double>, kTables> weight;  ///< form factor of ray k: cosθ_k / Σ cosθ

  /// The turn of a texel. It repeats every kTile texels, so that results commute with shifts by whole
  /// periods.
  LatticeTurn turn(int row, int column) const;
};

/// `count` in 1 … 65536.
HemisphereDirections make_hemisphere_directions(int count, std::uint64_t seed);

}  // namespace heightlight
