#pragma once

#include <array>
#include <vector>

#include "heightlight/screenspace.h"
#include "screenspace/slice_samples.h"

// GTAO of one row of receivers (Jimenez et al. 2016, algorithms 1 and 2).
//
// The view vector is z. Slice d, a unit vector of the plane, is spanned by d and z; in it, with c = n·d and
// the projected normal n̄ = c d + n_z z = |n̄| (sinγ d + cosγ z), a direction at the polar angle θ on the side
// of d has |n̄| cos(θ − γ) = c sinθ + n_z cosθ. Eq. 7's half for that side is therefore, with the horizon's
// elevation h = π/2 − θ₂ and its slope m = tan h,
//     |n̄| ∫₀^θ₂ cos(θ − γ) sinθ dθ = ∫_h^{π/2} (c cosη + n_z sinη) cosη dη
//                                  = ½ (c (π/2 − atan m − m q) + n_z q),   q = cos²h = 1/(1 + m²),
// the integral of an exact walk's azimuth, and the side of −d has −c. Likewise eqs. 20 and 21 are, with s =
// sin h and e = 1 − s,
//     along d:  c e² (2 + s)/3 + n_z cos³h/3,      along z:  c cos³h/3 + n_z e (1 + s + s²)/3.
// The paper knows cosine-weighted AO alone; the plain share of solid angle above the same horizons, α, is the
// mean of 1 − sin h. That needs one arc tangent a side, and neither |n̄| nor γ. The clamp of line 27 to the
// tangent hemisphere is m ≥ m₀ = −c/n_z. The cosine that line 24 takes the maximum of is sin h, which rises
// with the slope: where nothing attenuates it, the maximum of the slopes serves.
//
// Read literally, three things in the paper do not hold:
//   * Line 20, s ← sample/directionSampleCount, makes sample 0 the receiver itself, whose direction is 0/0,
//     and never looks at the end of the radius. Steps here end at the radius (StepDistribution).
//   * Eq. 10 takes ⟨ω_s, ω₀⟩⁺, a horizon that is never below the horizontal, line 18 starts at −1. A plane
//     tilted by γ shows which is right: eq. 10 says (1 + cos γ)/2, line 18 says 1.
//   * Line 10's axis, CROSS(directionV, viewV), is no unit vector unless they are square to each other, as
//     they are here but not off the axis of a perspective view; line 11 then leaves some of the normal's part
//     along it.

namespace heightlight {

/// Sums over the slices, per receiver in a row of the map.
struct GtaoSums {
  std::vector<float> sky;    ///< Σ over both sides of twice eq. 9's integrand
  std::vector<float> open;   ///< the same of an open hemisphere; empty where not asked for
  std::vector<float> solid;  ///< Σ over both sides of 1 − sin h, for α; empty where not asked for
  std::array<std::vector<float>, 3> bent;  ///< Σ of the bent normal's parts; empty where not asked for
};

/// How rows are looked at.
struct GtaoPass {
  const DepthBuffer& depth;
  const SliceTables& tables;
  bool attenuated = false;  ///< the cosines are followed, with the two options below
  float radius = 1e30F;     ///< where a sample's cosine has sunk to −1, by its distance in space
  float per_falloff = 1;    ///< 1 / the distance over which it sinks
  float thickness = 0;      ///< β of eq. 13
};

/// What attenuated slopes are kept within, so that their squares stay finite.
constexpr float kSteepestSlope = 1e6F;

/// Adds to the sums of the row's receivers. The readable one.
void gtao_row_scalar(const GtaoPass& pass, int row, GtaoSums& sums);

/// The fast one: receivers four apart side by side. The same, but for the rounding of fused products and of
/// the arc tangent (2e-8).
void gtao_row(const GtaoPass& pass, int row, GtaoSums& sums);

}  // namespace heightlight
