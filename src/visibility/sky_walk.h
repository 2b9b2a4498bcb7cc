#pragma once

#include <array>

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
// periodic function give it to within exp(−K asinh(n_z / √(1−n_z²))): only receivers steeper than kSteep need
// the second sum. α = Σ (1 − m √q) / K exactly: sin h₀ is odd in the azimuth, and K is even.

namespace heightlight {

/// Sums over the azimuths walked so far, per receiver of a tile.
struct SkySums {
  alignas(64) std::array<float, WalkTile::kTexels> sky{};    ///< Σ S(m)
  alignas(64) std::array<float, WalkTile::kTexels> full{};   ///< Σ S(m₀)
  alignas(64) std::array<float, WalkTile::kTexels> solid{};  ///< Σ (1 − sin h)
};

/// Slope of the normal's plane from which on Σ S(m₀) is summed, not taken as K.
constexpr float kSteep = 2.0F;

/// Walks one azimuth from every receiver of the tile. The readable one.
void walk_sky_scalar(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far, SkySums& sums);

/// The fast one: receivers side by side. The same sums, but for the rounding of fused products where the
/// machine has them, and of the arc tangent (2e-8).
void walk_sky(const WalkTile& tile, const AzimuthTable& azimuth, const FarView& far, SkySums& sums);

}  // namespace heightlight
