#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace heightlight {

// Directions stratified in solid angle over a hemisphere: a spherical Fibonacci lattice. Direction k of N has
//     cosθ_k = 1 − (k + o)/N,   φ_k = 2π frac(k g) + r,   g = (√5 − 1)/2,
// and stands for the solid angle 2π/N. If all receivers shared one lattice, its error would become a bias
// with a pattern. Each receiver therefore has its own rotation r and one of kTables offsets o. There are so
// few offsets because cosθ_k, and with it a ray's form factor, then depends on k and the table only: links
// need not store it.

/// One receiver's choice of lattice.
struct LatticeTurn {
  int table = 0;
  float cosine = 1;  ///< cos r; `sine` is sin r
  float sine = 0;
};

struct HemisphereDirections {
  static constexpr int kTables = 16;
  static constexpr int kTile = 64;  ///< period of the turns in both axes, texels

  int count = 0;
  std::uint64_t seed = 0;
  std::vector<float> azimuth_cosine;  ///< cos(2π frac(k g)), `count` of them
  std::vector<float> azimuth_sine;
  std::array<std::vector<float>, kTables> cosine;   ///< cosθ_k, falling with k
  std::array<std::vector<float>, kTables> sine;     ///< sinθ_k
  std::array<std::vector<double>, kTables> weight;  ///< form factor of ray k: cosθ_k / Σ cosθ

  /// The turn of a texel. Turns repeat every kTile texels, so that a map shifted by whole periods gives the
  /// same results, shifted.
  LatticeTurn turn(int row, int column) const;
};

/// Makes the lattice of `count` directions, 1 … 65536. `seed` selects the turns.
HemisphereDirections make_hemisphere_directions(int count, std::uint64_t seed);

}  // namespace heightlight
