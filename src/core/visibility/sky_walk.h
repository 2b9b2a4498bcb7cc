#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>

#include "visibility/distance_table.h"
#include "visibility/far_view.h"

// What the sky sends along one azimuth slice, in closed form.
//
// Let the receiver have the unit normal n, let d be the slice's direction in the plane, c = n·d, and let the
// horizon stand at elevation h, tan h = m. A direction at elevation θ is cosθ d + sinθ ẑ; it makes n·ω = c
// cosθ + n_z sinθ and dω = cosθ dθ dφ. Twice the slice's share of irradiance is
//     S(m) = 2 ∫_h^{π/2} (c cosθ + n_z sinθ) cosθ dθ = c (π/2 − h − sin h cos h) + n_z cos²h
//          = c (π/2 − atan m − m q) + n_z q,     q = cos²h = 1 / (1 + m²),
// and its share of solid angle is 1 − sin h = 1 − m √q. Directions below the tangent plane, which stands at
// the slope m₀ = −c / n_z, count for nothing: walks start there, so that m ≥ m₀.
//
// Over K azimuths, A = Σ S(m) / Σ S(m₀). The continuous mean of S(m₀) is 1, and K equal steps of a smooth
// periodic function give it to within exp(−K asinh(n_z / √(1−n_z²))): only receivers steeper than
// steep_slope(K) need the second sum. α = Σ (1 − m √q) / K exactly: sin h₀ is odd in the azimuth, and K is
// even.
//
// Moments of the sky are likewise closed forms. With s = sin h = m √q, e = 1 − s and ζ = π/2 − h − m q,
//     ∫ cos³θ = e² (2 + s)/3,   ∫ sinθ cos²θ = q √q/3,   ∫ sin²θ cosθ = e (1 + s + s²)/3,
//     ∫ cos⁴θ = 3/8 ζ − m q²/4,   ∫ sinθ cos³θ = q²/4,   ∫ sin²θ cos²θ = ζ/8 + m q²/4,
// from h to π/2, give, twice over, the slice's moments of ω along d and z, and of its squares along d d and d
// z; that of z z is S less that of d d. cos 2φ and sin 2φ turn d d into x² − y² and 2 xy.

namespace heightlight {

/// Receivers that are walked or left out together: the rows of a group, and as many columns as the widest
/// vector.
constexpr int kSkyBlockRows = WalkTile::kGroup;
constexpr int kSkyBlockColumns = 16;
constexpr int kSkyBlocksAcross = WalkTile::kSide / kSkyBlockColumns;
using SkyBlocks = std::bitset<static_cast<std::size_t>(WalkTile::kSide / kSkyBlockRows) * kSkyBlocksAcross>;

/// Index of the block that the receiver in row i and column j of a tile belongs to.
constexpr std::size_t sky_block(int i, int j) {
  return static_cast<std::size_t>(i / kSkyBlockRows * kSkyBlocksAcross + j / kSkyBlockColumns);
}

/// Slope of the normal's plane from which on Σ S(m₀) over so many azimuths in equal steps is summed, not
/// taken as their number: where exp(−K asinh(1/slope)) would exceed e^−10, and from 2 on.
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
  alignas(64) std::array<Values, 3> first{};   ///< wanted.first: Σ of twice the slices' moments of ω
  alignas(64) std::array<Values, 5> second{};  ///< wanted.second: of x² − y², xy, z², xz, yz

  BelowHorizontal below = BelowHorizontal::sky;  ///< ground: walks start at what is level, where that is
                                                 ///< higher than the tangent plane; S(m₀) stays

  bool keep_slope = false;
  alignas(64) Values slope{};  ///< keep_slope: of the last azimuth's horizon, m

  SkyBlocks blocks = SkyBlocks().set();  ///< whose receivers walk
  float steep = steep_slope(64);         ///< of the fewest azimuths that any receiver walks

  /// Before the first azimuth: of all blocks.
  void clear();
};

/// Walks one azimuth from every receiver of the tile. The readable one.
void walk_sky_scalar(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far, SkySums& sums);

/// Likewise, with occluders only as far as a maximum distance. Where slopes are kept, a sharp one is taken,
/// and the sky above its horizons.
void walk_sky_within_scalar(const WalkTile& tile, const AzimuthTable& azimuth,
                            const DistanceTable& maximum_distance, SkySums& sums);

/// The fast ones: receivers side by side. The same sums, but for the rounding of fused products where the
/// machine has them, and of the arc tangent (2e-8).
void walk_sky(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far, SkySums& sums);
void walk_sky_within(const WalkTile& tile, const AzimuthTable& azimuth, const DistanceTable& maximum_distance,
                     SkySums& sums);

}  // namespace heightlight
