#pragma once

#include <array>
#include <vector>

#include "heightlight/screenspace.h"
#include "screenspace/slice_samples.h"

// GTAO of one row of receivers (Jimenez et al. 2016, algorithms 1 and 2).
//
// The view vector is z. Slice d, a unit vector of the plane, is spanned by d and z. In it, with c = n·d and
// the projected normal n̄ = c d + n_z z = |n̄| (sinγ d + cosγ z), a direction at the polar angle θ on the
// side of d has |n̄| cos(θ − γ) = c sinθ + n_z cosθ. With the horizon's elevation h = π/2 − θ₂ and its slope
// m = tan h, this side's half of eq. 7 is
//     |n̄| ∫₀^θ₂ cos(θ − γ) sinθ dθ = ∫_h^{π/2} (c cosη + n_z sinη) cosη dη
//                                  = ½ (c (π/2 − atan m − m q) + n_z q),   q = cos²h = 1/(1 + m²),
// which is the integral of an exact walk's azimuth; the side of −d has −c. Similarly, eqs. 20 and 21 are,
// with s = sin h and e = 1 − s,
//     along d:  c e² (2 + s)/3 + n_z cos³h/3,      along z:  c cos³h/3 + n_z e (1 + s + s²)/3.
// The paper has cosine-weighted AO only. The plain share of solid angle above the same horizons, α, is the
// mean of 1 − sin h. This needs one arc tangent per side, and neither |n̄| nor γ. Line 27's clamp to the
// tangent hemisphere is m ≥ m₀ = −c/n_z. The cosine whose maximum line 24 takes is sin h, which rises with
// the slope: where nothing is attenuated, the maximum of the slopes suffices.
//
// Three things in the paper do not hold if they are read literally:
//   * Line 20, s ← sample/directionSampleCount, makes sample 0 the receiver itself, whose direction is 0/0,
//     and never examines the end of the radius. Here the steps end at the radius (StepDistribution).
//   * Eq. 10 takes ⟨ω_s, ω₀⟩⁺, a horizon that is never below the horizontal; line 18 starts at −1. A plane
//     tilted by γ shows which is right: eq. 10 gives (1 + cos γ)/2, line 18 gives 1.
//   * Line 10's axis, CROSS(directionV, viewV), is a unit vector only if the two are perpendicular, as they
//     are here but not off the axis of a perspective view; line 11 then leaves part of the normal's component
//     along it.

namespace heightlight {

/// Sums over the slices, per receiver in a row of the map.
struct GtaoSums {
  std::vector<float> sky;    ///< Σ over both sides of twice the integrand of eq. 9
  std::vector<float> open;   ///< the same for an open hemisphere; empty where not asked for
  std::vector<float> solid;  ///< Σ over both sides of 1 − sin h, for α; empty where not asked for
  std::array<std::vector<float>, 3> bent;  ///< Σ of the bent normal's components; empty where not asked for
};

/// How the receivers of a row look around.
struct GtaoPass {
  const DepthBuffer& depth;
  const SliceTables& tables;
  bool attenuated = false;  ///< whether samples are attenuated, by the options below
  float radius = 1e30F;     ///< distance in space at which a sample's cosine has fallen to −1
  float per_falloff = 1;    ///< 1 / the distance over which the cosine falls
  float thickness = 0;      ///< β of eq. 13
};

/// Bound of attenuated slopes, which keeps their squares finite.
constexpr float kSteepestSlope = 1e6F;

/// Adds to the sums of the row's receivers. The readable version.
void gtao_row_scalar(const GtaoPass& pass, int row, GtaoSums& sums);

/// As gtao_row_scalar, vectorized over receivers four columns apart. The results differ only by the rounding
/// of fused products and of the arc tangent (2e-8).
void gtao_row(const GtaoPass& pass, int row, GtaoSums& sums);

}  // namespace heightlight
