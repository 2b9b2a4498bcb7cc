#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>

#include "visibility/distance_table.h"
#include "visibility/far_view.h"

// What the sky sends along the slice of one azimuth, in closed form.
//
// Let the receiver have the unit normal n, let d be the slice's direction in the plane, c = n·d, and let the
// horizon stand at elevation h, tan h = m. A direction at elevation θ is cosθ d + sinθ ẑ. For it, n·ω = c
// cosθ + n_z sinθ and dω = cosθ dθ dφ. Twice the slice's part of the irradiance is
//     S(m) = 2 ∫_h^{π/2} (c cosθ + n_z sinθ) cosθ dθ = c (π/2 − h − sin h cos h) + n_z cos²h
//          = c (π/2 − atan m − m q) + n_z q,     q = cos²h = 1 / (1 + m²),
// and its part of the solid angle is 1 − sin h = 1 − m √q. Directions below the tangent plane, whose slope is
// m₀ = −c / n_z, do not count: walks start at m₀, so that m ≥ m₀.
//
// Over K azimuths, A = Σ S(m) / Σ S(m₀). The continuous mean of S(m₀) is 1. K equal steps of a smooth
// periodic function give this mean to within exp(−K asinh(n_z / √(1−n_z²))), so that only receivers steeper
// than steep_slope(K) need the second sum. α = Σ (1 − m √q) / K is exact, because sin h₀ is odd in the
// azimuth and K is even.
//
// Moments of the sky have closed forms, too. With s = sin h = m √q, e = 1 − s and ζ = π/2 − h − m q, the
// integrals from h to π/2 are
//     ∫ cos³θ = e² (2 + s)/3,   ∫ sinθ cos²θ = q √q/3,   ∫ sin²θ cosθ = e (1 + s + s²)/3,
//     ∫ cos⁴θ = 3/8 ζ − m q²/4,   ∫ sinθ cos³θ = q²/4,   ∫ sin²θ cos²θ = ζ/8 + m q²/4.
// Twice these integrals, combined with c and n_z, give the slice's moments of ω along d and z, of ω_d² and of
// ω_d ω_z. The moment of ω_z² is S less the moment of ω_d². Times cos 2φ and sin 2φ, the moment of ω_d² gives
// the moments of x² − y² and 2 xy.

namespace heightlight {

/// Size of a block of receivers that are walked or left out together: the rows of a group, and as many
/// columns as the widest vector has lanes.
constexpr int kSkyBlockRows = WalkTile::kGroup;
constexpr int kSkyBlockColumns = 16;
constexpr int kSkyBlocksAcross = WalkTile::kSide / kSkyBlockColumns;
using SkyBlocks = std::bitset<static_cast<std::size_t>(WalkTile::kSide / kSkyBlockRows) * kSkyBlocksAcross>;

/// Index of the block that the receiver in row i and column j of a tile belongs to.
constexpr std::size_t sky_block(int i, int j) {
  return static_cast<std::size_t>(i / kSkyBlockRows * kSkyBlocksAcross + j / kSkyBlockColumns);
}

/// Slope of the tangent plane from which on Σ S(m₀) over `azimuths` azimuths in equal steps is summed and not
/// taken as their number: where exp(−K asinh(1/slope)) would exceed e^−10, and from slope 2 on in any case.
inline float steep_slope(int azimuths) {
  constexpr double kSteepest = 2;
  return static_cast<float>(std::min(kSteepest, 1 / std::sinh(10.0 / azimuths)));
}

/// Sums over the azimuths walked so far, per receiver of a tile.
struct SkySums {
  using Values = std::array<float, WalkTile::kTexels>;

  alignas(64) Values sky{};    ///< Σ S(m)
  alignas(64) Values full{};   ///< Σ S(m₀)
  alignas(64) Values solid{};  ///< Σ (1 − sin h)

  SkyWanted wanted;
  alignas(64) std::array<Values, 3> first{};   ///< if wanted.first: Σ of twice the slices' moments of ω
  alignas(64) std::array<Values, 5> second{};  ///< if wanted.second: the same of x² − y², xy, z², xz, yz

  BelowHorizontal below = BelowHorizontal::sky;  ///< ground: walks start at what is level, where that is
                                                 ///< higher than the tangent plane; S(m₀) does not change

  bool keep_slope = false;
  alignas(64) Values slope{};  ///< if keep_slope: slope m of the last azimuth's horizon

  SkyBlocks blocks = SkyBlocks().set();  ///< blocks whose receivers walk
  float steep = steep_slope(64);         ///< steep_slope of the fewest azimuths that any receiver walks

  /// Sets the sums to 0 and selects all blocks; to be called before the first azimuth.
  void clear();
};

/// Walks one azimuth from every receiver of the selected blocks of the tile. The readable implementation.
void walk_sky_scalar(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far, SkySums& sums);

/// As walk_sky_scalar, but only occluders within a maximum distance count. Where slopes are kept, the maximum
/// distance is taken to be sharp, and the sums hold the sky above its horizons.
void walk_sky_within_scalar(const WalkTile& tile, const AzimuthTable& azimuth,
                            const DistanceTable& maximum_distance, SkySums& sums);

/// The fast implementations, with receivers side by side. They give the same sums except for the rounding of
/// fused products, where the machine has them, and of the arc tangent (2e-8).
void walk_sky(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far, SkySums& sums);
void walk_sky_within(const WalkTile& tile, const AzimuthTable& azimuth, const DistanceTable& maximum_distance,
                     SkySums& sums);

}  // namespace heightlight
