#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "heightlight/curves.h"
#include "heightlight/image.h"
#include "heightlight/surface.h"
#include "heightlight/transport.h"

namespace heightlight {

// Closed forms of the total irradiance E/π (unoccluded = 1) under a sky of radiance 1, after all bounces on a
// surface of albedo ρ everywhere, from what a texel is known to be. Pure functions, of float or double; where
// albedo is coloured, call them once per channel. Every AO is a type of its own, so that a form never gets
// the wrong kind: AmbientOcclusion{0.5} and SkyViewFactor{0.5} do not convert into each other, nor from
// numbers.
//
// Arguments lie in [0, 1]; AO that rounding or measurement put outside is clamped to it. NaN gives NaN.

/// α, the plain share of the hemisphere's solid angle that sees the sky: the notes' AO (file 004).
template <class Real>
struct AmbientOcclusion {
  constexpr explicit AmbientOcclusion(Real share) : value(share) {}
  Real value;
};

/// A = E₀/π, the cosine-weighted share: the AO of files 000 and 002.
template <class Real>
struct SkyViewFactor {
  constexpr explicit SkyViewFactor(Real share) : value(share) {}
  Real value;
};

/// n, the mean sky view factor of what a texel sees of the surface, weighted by form factor. Where it is
/// measured: E₁/π ÷ (1 − A) at ρ = 1.
template <class Real>
struct SeenSkyViewFactor {
  constexpr explicit SeenSkyViewFactor(Real share) : value(share) {}
  Real value;
};

/// Shares as measured stray out of [0, 1] by rounding.
template <class Real>
constexpr Real clamp_share(Real share) {
  return std::clamp(share, Real{0}, Real{1});
}

/// "AO × π", taken for the whole of it: E/π = A, at any ρ. Exact at ρ = 0.
template <class Real>
constexpr Real direct_irradiance(SkyViewFactor<Real> sky) {
  return clamp_share(sky.value);
}

/// The same with the other AO: E/π = α (file 004 eq. 4). Not even exact at ρ = 0.
template <class Real>
constexpr Real direct_irradiance(AmbientOcclusion<Real> occlusion) {
  return clamp_share(occlusion.value);
}

/// Constants of the notes' form (file 004 eqs. 7 and 11); as published unless fitted anew.
struct NotesConstants {
  double direct_gain = 0.5;                ///< F₀(α) = α (1 + gain (1 − α)^power)
  double direct_power = 0.75;              ///< below 1, F₀ exceeds 1 near α = 1 whatever the gain
  double first_gain = 27.576937094210385;  ///< F₁(α) = gain α (1 − α)^1.5 exp(−decay α^¼)
  double first_decay = 3.3364392003423804;
};

/// F₀, file 004 eq. 7: E₀/π as a function of α. As published it exceeds 1, by up to 0.0062, where α > 0.9493.
template <class Real>
Real notes_direct(AmbientOcclusion<Real> occlusion, const NotesConstants& constants = {}) {
  const Real a = clamp_share(occlusion.value);
  return a * (1 + static_cast<Real>(constants.direct_gain) *
                      std::pow(1 - a, static_cast<Real>(constants.direct_power)));
}

/// F₁, file 004 eq. 11: E₁/π at ρ = 1 as a function of α.
template <class Real>
Real notes_first_bounce(AmbientOcclusion<Real> occlusion, const NotesConstants& constants = {}) {
  const Real a = clamp_share(occlusion.value);
  return static_cast<Real>(constants.first_gain) * a * (1 - a) * std::sqrt(1 - a) *
         std::exp(-static_cast<Real>(constants.first_decay) * std::sqrt(std::sqrt(a)));
}

/// τ, file 004 eq. 9: the ratio of each bounce to the one before it, 1 − F₁/(1 − F₀). Negative for α > 0.764
/// as published. Nothing where F₀ ≥ 1, which no geometric series can bring to a sum of 1.
template <class Real>
std::optional<Real> notes_ratio(AmbientOcclusion<Real> occlusion, const NotesConstants& constants = {}) {
  const Real missing = 1 - notes_direct(occlusion, constants);
  if (missing <= 0) return std::nullopt;
  return 1 - notes_first_bounce(occlusion, constants) / missing;
}

/// File 004 eqs. 10 and 12: F₀ + ρ F₁/(1 − ρτ). With eq. 9 for τ that is
///     F₀ + ρ F₁ (1 − F₀)/((1 − ρ)(1 − F₀) + ρ F₁),
/// which loses no digits where F₀ comes near 1. In its domain it lies in [0, 1], rises with ρ and is 1 at ρ =
/// 1. Nothing outside: where F₀ ≥ 1 (as published: α > 0.9493, and α = 1), and where no bounce brings
/// anything at ρ = 1 (ρτ = 1, at α = 0).
template <class Real>
std::optional<Real> notes_total(AmbientOcclusion<Real> occlusion, Real albedo,
                                const NotesConstants& constants = {}) {
  const Real direct = notes_direct(occlusion, constants);
  const Real missing = 1 - direct;
  if (missing <= 0) return std::nullopt;
  const Real first = albedo * notes_first_bounce(occlusion, constants);
  const Real rest = (1 - albedo) * missing + first;
  if (rest <= 0) return std::nullopt;
  return direct + missing * (first / rest);  // in this order it is never above 1
}

/// notes_total with an answer everywhere, as a renderer needs it: 1 where F₀ ≥ 1 (nearly open, and full
/// already) and where ρτ = 1 (at ρ = 1 all totals are 1).
template <class Real>
Real notes_total_guarded(AmbientOcclusion<Real> occlusion, Real albedo,
                         const NotesConstants& constants = {}) {
  return notes_total(occlusion, albedo, constants).value_or(1);
}

/// File 000 eq. 12: A/(1 − ρ(1 − A)), from taking what is seen to be as bright as the place that sees it. At
/// A = 0, ρ = 1, where it is 0/0: 1, as along all of ρ = 1.
template <class Real>
constexpr Real uniform_neighbourhood(SkyViewFactor<Real> sky, Real albedo) {
  const Real a = clamp_share(sky.value);
  const Real rest = (1 - albedo) + albedo * a;  // 1 − ρ(1 − A), without cancellation near (0, 1)
  return rest <= 0 ? Real{1} : a / rest;
}

/// Jimenez' cubic a A³ − b A² + c A with coefficients linear in ρ (file 000 eq. 33); as published unless
/// fitted anew. He fitted them to three bounces at ρ = 0.1 … 0.9.
struct CubicConstants {
  double a_slope = 2.0404, a_offset = -0.3324;
  double b_slope = 4.7951, b_offset = -0.6417;
  double c_slope = 2.7552, c_offset = 0.6903;
};

/// File 000 eq. 33. As published it is below A at ρ = 0, by up to 0.044, and not 1 at ρ = 1 (0.90 at A =
/// 0.5); it exceeds 1 by up to 10⁻⁴ near A = 1, which is clamped.
template <class Real>
constexpr Real cubic_total(SkyViewFactor<Real> sky, Real albedo, const CubicConstants& constants = {}) {
  const auto linear = [albedo](double slope, double offset) {
    return static_cast<Real>(slope) * albedo + static_cast<Real>(offset);
  };
  const Real a = clamp_share(sky.value);
  return clamp_share(
      ((linear(constants.a_slope, constants.a_offset) * a - linear(constants.b_slope, constants.b_offset)) *
           a +
       linear(constants.c_slope, constants.c_offset)) *
      a);
}

/// μ of file 002, section 3: how far a surface at `distance` counts as open, √(d/R) up to the radius R > 0, 1
/// beyond.
template <class Real>
Real fuzzy_openness(Real distance, Real radius) {
  return distance >= radius ? Real{1} : std::sqrt(distance / radius);
}

/// What a texel sees in one direction, for the ambient transfer.
template <class Real>
struct Occluder {
  Real form_factor;  ///< share of the cosine-weighted hemisphere
  Real openness;     ///< μ in [0, 1]; 0 for a surface that hides the sky altogether
  Real albedo;       ///< where it is hit
};

/// File 002 eqs. 5 and 6: O/(1 − Σ F (1 − μ) ρ), with the obscurance O = A + Σ F μ. With μ = 0 and one albedo
/// it is uniform_neighbourhood. `occluders`: any range of Occluder<Real> whose form factors sum to 1 − A. 1
/// where it is 0/0, as there.
template <class Real, class Range>
Real ambient_transfer(SkyViewFactor<Real> sky, const Range& occluders) {
  Real obscurance = sky.value;
  Real rest = sky.value;  // 1 − Σ F (1 − μ) ρ = A + Σ F (1 − (1 − μ) ρ)
  for (const Occluder<Real>& seen : occluders) {
    obscurance += seen.form_factor * seen.openness;
    rest += seen.form_factor * (1 - (1 - seen.openness) * seen.albedo);
  }
  return rest <= 0 ? Real{1} : clamp_share(obscurance / rest);
}

/// G(A, n, ρ) = A + ρ(1 − A) n/(1 − ρ(1 − n)): the first bounce brings ρ(1 − A)n, and every later one ρ(1 −
/// n) of the one before, the ratio that lets all of them sum to 1 at ρ = 1. Exact at ρ = 0 and ρ = 1, without
/// poles, in [0, 1], rising with ρ and with n. At n = 0, ρ = 1, where it is 0/0: 1, as along all of ρ = 1.
/// With n = A it is uniform_neighbourhood.
template <class Real>
constexpr Real bounced_total(SkyViewFactor<Real> sky, SeenSkyViewFactor<Real> seen, Real albedo) {
  const Real a = clamp_share(sky.value);
  const Real n = clamp_share(seen.value);
  const Real rest = (1 - albedo) + albedo * n;
  return rest <= 0 ? Real{1} : a + (1 - a) * (albedo * n / rest);
}

/// The n with which bounced_total gives `total` at `albedo`, 0 < albedo < 1: with q = (G − A)/(1 − A), n =
/// q(1 − ρ)/(ρ(1 − q)), in [0, 1]. Where nothing is seen (A = 1) any n does; it is 1 there.
template <class Real>
constexpr SeenSkyViewFactor<Real> seen_from_total(SkyViewFactor<Real> sky, Real total, Real albedo) {
  assert(albedo > 0 && albedo < 1);
  const Real a = clamp_share(sky.value);
  const Real missing = albedo * (1 - total);        // ρ(1 − q)(1 − A)
  const Real brought = (1 - albedo) * (total - a);  // (1 − ρ) q (1 − A)
  return SeenSkyViewFactor<Real>(a >= 1 || brought >= missing ? Real{1} : clamp_share(brought / missing));
}

/// The albedo at which an n that is stored as a second channel is best solved for: there its error vanishes,
/// and is least from 0.3 to 0.9 all together.
constexpr double kSeenAlbedo = 0.7;

/// What a total may be.
template <class Real>
struct TotalBounds {
  Real low;
  Real high;
};

/// Bounds of the total at `albedo` that hold on any surface, from A and the total at another albedo ρ₀, 0 <
/// ρ₀ < 1. What bounces bring, f(ρ) = Σ_{b ≥ 1} E_b ρ^b, has no negative E_b and f(1) = 1 − A. With q =
/// f(ρ₀)/f(1), the mean of ρ₀^b weighted by E_b, Jensen's inequality for ρ^b = (ρ₀^b)^γ, γ = ln ρ/ln ρ₀,
/// gives q^γ on one side; on the other the chord of that power from 0 to ρ₀ gives q ρ/ρ₀. bounced_total lies
/// between them too.
template <class Real>
TotalBounds<Real> bound_total(SkyViewFactor<Real> sky, Real total, Real total_albedo, Real albedo) {
  assert(total_albedo > 0 && total_albedo < 1);
  const Real a = clamp_share(sky.value);
  if (a >= 1) return {a, a};
  const Real q = std::clamp((total - a) / (1 - a), Real{0}, total_albedo);
  const Real by_jensen = albedo <= 0 ? Real{0} : std::pow(q, std::log(albedo) / std::log(total_albedo));
  const Real by_chord = q * albedo / total_albedo;
  return {a + (1 - a) * std::min(by_jensen, by_chord), a + (1 - a) * std::max(by_jensen, by_chord)};
}

/// Guesses of n, as fitted to the maps of plots/make-models. Each keeps n in [0, 1].
struct SeenConstants {
  double offset = 0.07, slope = 0.82;                                  ///< from A alone
  double map_offset = 0.012, map_slope = 0.62, map_curvature = -0.17;  ///< from A and the map's s
  double deep_slope = 0.69, deep_bend = -0.65;                         ///< from A and the map's t
  double blur_offset = 0.013, blur_slope = 0.32;                       ///< from A and its blur
};

/// n from A alone: offset + slope A.
template <class Real>
constexpr SeenSkyViewFactor<Real> guess_seen(SkyViewFactor<Real> sky, const SeenConstants& constants = {}) {
  return SeenSkyViewFactor<Real>(clamp_share(static_cast<Real>(constants.offset) +
                                             static_cast<Real>(constants.slope) * clamp_share(sky.value)));
}

/// n from A and one number per map, s = expected_seen(…): offset + s + slope (A − s) + curvature (A − s)².
template <class Real>
constexpr SeenSkyViewFactor<Real> guess_seen_on_map(SkyViewFactor<Real> sky, SeenSkyViewFactor<Real> expected,
                                                    const SeenConstants& constants = {}) {
  const Real s = clamp_share(expected.value);
  const Real d = clamp_share(sky.value) - s;
  return SeenSkyViewFactor<Real>(clamp_share(
      static_cast<Real>(constants.map_offset) + s +
      d * (static_cast<Real>(constants.map_slope) + d * static_cast<Real>(constants.map_curvature))));
}

/// What a map's n and A say about t, the n of its deepest places: sums over its texels weighted by w =
/// (∂G/∂n)² at albedo ½, so that errors of n count as what they do to the total.
struct SeenMoments {
  double weight = 0;    ///< Σ w
  double sky = 0;       ///< Σ w A
  double sky_sky = 0;   ///< Σ w A²
  double seen = 0;      ///< Σ w n
  double seen_sky = 0;  ///< Σ w n A

  void add(SkyViewFactor<double> sky_view_factor, SeenSkyViewFactor<double> n);
};

/// t, one number per map, from its simulation: the one with which guess_seen_in_deep comes nearest to the
/// map's own n, in least squares. 1 where nothing is occluded.
SeenSkyViewFactor<double> tune_deep_seen(const SeenMoments& moments, const SeenConstants& constants = {});

/// n from A and t = tune_deep_seen(…): t + (slope + bend t) A.
template <class Real>
constexpr SeenSkyViewFactor<Real> guess_seen_in_deep(SkyViewFactor<Real> sky, SeenSkyViewFactor<Real> deep,
                                                     const SeenConstants& constants = {}) {
  const Real t = deep.value;
  return SeenSkyViewFactor<Real>(
      clamp_share(t + (static_cast<Real>(constants.deep_slope) + static_cast<Real>(constants.deep_bend) * t) *
                          clamp_share(sky.value)));
}

/// n from A and its blurred neighbourhood W = blur_seen(…): offset + W + slope (A − W).
template <class Real>
constexpr SeenSkyViewFactor<Real> guess_seen_by_blur(SkyViewFactor<Real> sky, SeenSkyViewFactor<Real> blurred,
                                                     const SeenConstants& constants = {}) {
  const Real w = clamp_share(blurred.value);
  return SeenSkyViewFactor<Real>(
      clamp_share(static_cast<Real>(constants.blur_offset) + w +
                  static_cast<Real>(constants.blur_slope) * (clamp_share(sky.value) - w)));
}

/// Everything that a closed form may want to know of a texel.
struct ModelInputs {
  AmbientOcclusion<double> ambient_occlusion{0};
  SkyViewFactor<double> sky_view_factor{0};
  SeenSkyViewFactor<double> expected_seen{0};  ///< s, one number per map
  SeenSkyViewFactor<double> deep_seen{0};      ///< t, one number per map
  SeenSkyViewFactor<double> blurred{0};        ///< W, the blurred sky view factor
  SeenSkyViewFactor<double> seen{0};           ///< n, stored as a second channel
};

/// What a closed form needs beside its AO.
enum class ExtraInput { none, expected_seen, deep_seen, blurred, seen };

/// One closed form of the list.
struct ClosedForm {
  std::string name;         ///< as in tables, snake_case
  std::string description;  ///< the formula
  std::string source;       ///< seed file and equation, or "here"
  AoKind kind = AoKind::sky_view_factor;
  ExtraInput extra = ExtraInput::none;
  /// E/π at an albedo in [0, 1]; nothing outside the form's domain.
  std::function<std::optional<double>(const ModelInputs&, double albedo)> evaluate;
};

/// The closed forms that need no more than ModelInputs, published ones first, with their constants as
/// published or as SeenConstants says.
const std::vector<ClosedForm>& closed_forms();

/// s = Σ A(1 − A)/n_z ÷ Σ (1 − A)/n_z over the map: the mean of n, weighted by (1 − A)/n_z, that reciprocity
/// asks for, since 1/n_z F is symmetric. From the sky view factor and the normals alone. 1 where nothing is
/// occluded. Texels that are NaN are left out. Throws Error for maps of different sizes.
SeenSkyViewFactor<double> expected_seen(const Map& sky_view_factor, const Surface& surface);

/// The same mean as measured: Σ E₁/n_z ÷ Σ (1 − A)/n_z, with `first_bounce` E₁/π at ρ = 1, 0 where missing.
/// How far it is from expected_seen tells how well the samples resolve the surface.
SeenSkyViewFactor<double> measured_seen(const Map& sky_view_factor, const TexelVector& first_bounce,
                                        const Surface& surface);

/// The blur with which n is guessed best on the maps of plots/make-models, in texels.
constexpr double kBlurSigma = 1.5;

/// W: the sky view factor averaged by a Gaussian of `sigma` texels > 0 (cut at 3 σ; wrapped where the map
/// tiles, ended at its edges where not) with weights 1 − A, since occluded places are what is seen. From the
/// sky view factor alone. The plain A where nothing near is occluded; NaN where missing.
Map blur_seen(const Map& sky_view_factor, bool tiles, double sigma = kBlurSigma);

}  // namespace heightlight
