#pragma once

#include <cmath>

// Closed forms of the total irradiance E/π (unoccluded = 1) under a sky of radiance 1, after all bounces on a
// surface of albedo ρ everywhere, from what a texel is known to be. This file needs C++17 and <cmath> and
// nothing else: an engine may take it alone. Pure functions, of float or double; where albedo is coloured,
// call them once per channel. Every AO is a type of its own, so that a form never gets the wrong kind:
// AmbientOcclusion{0.5} and SkyViewFactor{0.5} do not convert into each other, nor from numbers.
//
// Arguments lie in [0, 1]; AO that rounding or measurement put outside is clamped to it. NaN gives NaN, and
// so does a form outside its domain.
//
// Each form is stated here and nowhere else: its function, its constants, and beside them its name, formula
// and source in words and its text as a shader function. Evaluation, fits, plots and emitted shaders take
// them from here. Shader text is in the part of GLSL that is printed in every shading language (shaders.h
// tells it); $name stands for the constant of that name.

namespace heightlight {

/// What is said of a form, and what a shader is told.
struct FormText {
  const char* name;     ///< as in tables, snake_case
  const char* formula;  ///< plain ASCII
  const char* source;   ///< paper and equation, or "here"
  const char* shader;   ///< functions, the last of which is the form
};

/// A constant of a form that fits may change: its name in shaders, and where it is kept.
template <class Constants>
struct FormConstant {
  const char* name;
  double Constants::*value;
};

/// α, the plain share of the hemisphere's solid angle that sees the sky: the notes' AO (Patapom).
template <class Real>
struct AmbientOcclusion {
  constexpr explicit AmbientOcclusion(Real share) : value(share) {}
  Real value;
};

/// A = E₀/π, the cosine-weighted share: the AO of Jimenez et al. 2016 and Umenhoffer et al. 2009.
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
  return share < Real{0} ? Real{0} : Real{1} < share ? Real{1} : share;
}

/// The same in shaders.
inline constexpr const char* kShareShader = R"(float heightlight_share(float x) {
  return min(max(x, 0.0), 1.0);
}
)";

// The direct irradiance, taken for the whole of it
// ----------------------------------------------------------------------

inline constexpr FormText kDirectText{"direct", "A", "AO x pi", ""};
inline constexpr FormText kDirectAlphaText{"direct_alpha", "alpha", "Patapom, eq. 4", ""};

/// "AO × π": E/π = A, at any ρ. Exact at ρ = 0.
template <class Real>
constexpr Real direct_irradiance(SkyViewFactor<Real> sky) {
  return clamp_share(sky.value);
}

/// The same with the other AO: E/π = α (Patapom, eq. 4). Not even exact at ρ = 0.
template <class Real>
constexpr Real direct_irradiance(AmbientOcclusion<Real> occlusion) {
  return clamp_share(occlusion.value);
}

// The notes' F₀, F₁ and τ (Patapom)
// -------------------------------------------------------------------------------

/// Constants of the notes' form (Patapom, eqs. 7 and 11); as published unless fitted anew.
struct NotesConstants {
  double direct_gain = 0.5;                ///< F₀(α) = α (1 + gain (1 − α)^power)
  double direct_power = 0.75;              ///< below 1, F₀ exceeds 1 near α = 1 whatever the gain
  double first_gain = 27.576937094210385;  ///< F₁(α) = gain α (1 − α)^1.5 exp(−decay α^¼)
  double first_decay = 3.3364392003423804;
};

inline constexpr FormConstant<NotesConstants> kNotesConstants[] = {
    {"direct_gain", &NotesConstants::direct_gain},
    {"direct_power", &NotesConstants::direct_power},
    {"first_gain", &NotesConstants::first_gain},
    {"first_decay", &NotesConstants::first_decay}};

inline constexpr FormText kNotesDirectText{"notes_direct", "alpha (1 + gain (1 - alpha)^power)",
                                           "Patapom, eq. 7", ""};
inline constexpr FormText kNotesFirstBounceText{
    "notes_first_bounce", "A alpha (1 - alpha)^1.5 exp(-B alpha^0.25)", "Patapom, eq. 11", ""};
inline constexpr FormText kNotesText{"notes", "F0 + rho F1/(1 - rho tau)", "Patapom, eqs. 7, 9 to 12",
                                     R"(float heightlight_notes$suffix(float alpha, float albedo) {
  float a = heightlight_share(alpha);
  float direct = a * (1.0 + ($direct_gain) * pow(1.0 - a, $direct_power));
  float first = $first_gain * a * (1.0 - a) * sqrt(1.0 - a) * exp(-($first_decay) * sqrt(sqrt(a)));
  return heightlight_bounce_sum(direct, first, albedo);
}
)"};

/// What the notes' form ends with, whatever its constants: F₀ + ρ F₁/(1 − ρτ), as sum_bounces_guarded
/// sums it.
inline constexpr const char* kBounceSumShader =
    R"(float heightlight_bounce_sum(float direct, float first, float albedo) {
  float missing = 1.0 - direct;
  float brought = albedo * first;
  float rest = (1.0 - albedo) * missing + brought;
  if (missing <= 0.0 || rest <= 0.0) { return 1.0; }
  return direct + missing * (brought / rest);
}
)";

/// F₀, Patapom, eq. 7: E₀/π as a function of α. As published it exceeds 1, by up to 0.0062, where α > 0.9493.
template <class Real>
Real notes_direct(AmbientOcclusion<Real> occlusion, const NotesConstants& constants = {}) {
  const Real a = clamp_share(occlusion.value);
  return a * (1 + static_cast<Real>(constants.direct_gain) *
                      std::pow(1 - a, static_cast<Real>(constants.direct_power)));
}

/// F₁, Patapom, eq. 11: E₁/π at ρ = 1 as a function of α.
template <class Real>
Real notes_first_bounce(AmbientOcclusion<Real> occlusion, const NotesConstants& constants = {}) {
  const Real a = clamp_share(occlusion.value);
  return static_cast<Real>(constants.first_gain) * a * (1 - a) * std::sqrt(1 - a) *
         std::exp(-static_cast<Real>(constants.first_decay) * std::sqrt(std::sqrt(a)));
}

/// τ, Patapom, eq. 9: the ratio of each bounce to the one before it, 1 − F₁/(1 − F₀). Negative for α > 0.764
/// as published. NaN where F₀ ≥ 1, which no geometric series can bring to a sum of 1.
template <class Real>
Real notes_ratio(AmbientOcclusion<Real> occlusion, const NotesConstants& constants = {}) {
  const Real missing = 1 - notes_direct(occlusion, constants);
  if (missing <= 0) return static_cast<Real>(NAN);
  return 1 - notes_first_bounce(occlusion, constants) / missing;
}

/// Patapom, eqs. 10 and 12, from F₀, F₁ and ρ: F₀ + ρ F₁/(1 − ρτ). With eq. 9 for τ that is
///     F₀ + ρ F₁ (1 − F₀)/((1 − ρ)(1 − F₀) + ρ F₁),
/// which loses no digits where F₀ comes near 1. In its domain it lies in [0, 1], rises with ρ and is 1 at ρ =
/// 1. NaN outside: where F₀ ≥ 1, and where no bounce brings anything at ρ = 1 (ρτ = 1).
template <class Real>
constexpr Real sum_bounces(Real direct, Real first, Real albedo) {
  const Real missing = 1 - direct;
  if (missing <= 0) return static_cast<Real>(NAN);
  const Real brought = albedo * first;
  const Real rest = (1 - albedo) * missing + brought;
  if (rest <= 0) return static_cast<Real>(NAN);
  return direct + missing * (brought / rest);  // in this order it is never above 1
}

/// The notes' total: sum_bounces of their F₀ and F₁. Outside its domain, as published: α > 0.9493, α = 1, and
/// α = 0 at ρ = 1.
template <class Real>
Real notes_total(AmbientOcclusion<Real> occlusion, Real albedo, const NotesConstants& constants = {}) {
  return sum_bounces(notes_direct(occlusion, constants), notes_first_bounce(occlusion, constants), albedo);
}

/// sum_bounces with an answer everywhere, as a renderer needs it: 1 where F₀ ≥ 1 (nearly open, and full
/// already) and where ρτ = 1 (at ρ = 1 all totals are 1). NaN of NaN only.
template <class Real>
Real sum_bounces_guarded(Real direct, Real first, Real albedo) {
  const Real total = sum_bounces(direct, first, albedo);
  return std::isnan(total) && !std::isnan(direct + first + albedo) ? Real{1} : total;
}

/// notes_total, likewise.
template <class Real>
Real notes_total_guarded(AmbientOcclusion<Real> occlusion, Real albedo,
                         const NotesConstants& constants = {}) {
  return sum_bounces_guarded(notes_direct(occlusion, constants), notes_first_bounce(occlusion, constants),
                             albedo);
}

// Jimenez' two forms (Jimenez et al. 2016)
// ------------------------------------------------------------------------------------

inline constexpr FormText kUniformNeighbourhoodText{
    "uniform_neighbourhood", "A/(1 - rho (1 - A))",
    "Jimenez et al. 2016, eq. 12; Umenhoffer et al. 2009, eq. 6",
    R"(float heightlight_uniform_neighbourhood(float sky, float albedo) {
  float a = heightlight_share(sky);
  float rest = (1.0 - albedo) + albedo * a;
  if (rest <= 0.0) { return 1.0; }
  return a / rest;
}
)"};

/// Jimenez et al. 2016, eq. 12: A/(1 − ρ(1 − A)), from taking what is seen to be as bright as the place that
/// sees it. At A = 0, ρ = 1, where it is 0/0: 1, as along all of ρ = 1.
template <class Real>
constexpr Real uniform_neighbourhood(SkyViewFactor<Real> sky, Real albedo) {
  const Real a = clamp_share(sky.value);
  const Real rest = (1 - albedo) + albedo * a;  // 1 − ρ(1 − A), without cancellation near (0, 1)
  return rest <= 0 ? Real{1} : a / rest;
}

/// Jimenez' cubic a A³ − b A² + c A with coefficients linear in ρ (Jimenez et al. 2016, eq. 33); as published
/// unless fitted anew. He fitted them to three bounces at ρ = 0.1 … 0.9.
struct CubicConstants {
  double a_slope = 2.0404, a_offset = -0.3324;
  double b_slope = 4.7951, b_offset = -0.6417;
  double c_slope = 2.7552, c_offset = 0.6903;
};

inline constexpr FormConstant<CubicConstants> kCubicConstants[] = {
    {"a_slope", &CubicConstants::a_slope}, {"a_offset", &CubicConstants::a_offset},
    {"b_slope", &CubicConstants::b_slope}, {"b_offset", &CubicConstants::b_offset},
    {"c_slope", &CubicConstants::c_slope}, {"c_offset", &CubicConstants::c_offset}};

inline constexpr FormText kCubicText{"cubic", "a A^3 - b A^2 + c A", "Jimenez et al. 2016, eq. 33",
                                     R"(float heightlight_cubic$suffix(float sky, float albedo) {
  float a = heightlight_share(sky);
  float a3 = $a_slope * albedo + ($a_offset);
  float a2 = $b_slope * albedo + ($b_offset);
  float a1 = $c_slope * albedo + ($c_offset);
  return heightlight_share(((a3 * a - a2) * a + a1) * a);
}
)"};

/// The polynomial of eq. 33 itself, which may leave [0, 1].
template <class Real>
constexpr Real cubic_polynomial(SkyViewFactor<Real> sky, Real albedo, const CubicConstants& constants = {}) {
  const Real a3 = static_cast<Real>(constants.a_slope) * albedo + static_cast<Real>(constants.a_offset);
  const Real a2 = static_cast<Real>(constants.b_slope) * albedo + static_cast<Real>(constants.b_offset);
  const Real a1 = static_cast<Real>(constants.c_slope) * albedo + static_cast<Real>(constants.c_offset);
  const Real a = clamp_share(sky.value);
  return ((a3 * a - a2) * a + a1) * a;
}

/// Jimenez et al. 2016, eq. 33. As published it is below A at ρ = 0, by up to 0.044, and not 1 at ρ = 1 (0.90
/// at A = 0.5); it exceeds 1 by up to 10⁻⁴ near A = 1, which is clamped.
template <class Real>
constexpr Real cubic_total(SkyViewFactor<Real> sky, Real albedo, const CubicConstants& constants = {}) {
  return clamp_share(cubic_polynomial(sky, albedo, constants));
}

// Ambient transfer (Umenhoffer et al. 2009)
// --------------------------------------------------------------------------------------

/// μ of Umenhoffer et al. 2009, section 3: how far a surface at `distance` counts as open, √(d/R) up to the
/// radius R > 0, 1 beyond.
template <class Real>
Real fuzzy_openness(Real distance, Real radius) {
  return distance >= radius ? Real{1} : std::sqrt(distance / radius);
}

/// How fast the exponential μ rises: σ R, the number of mean free paths up to the radius.
inline constexpr double kOpennessRate = 4;

/// The exponential μ of Umenhoffer et al. 2009, section 2, 1 − exp(−σ d), which its authors leave since it
/// never ends: here σ is kOpennessRate/R, and it is scaled to be 1 at the radius R > 0 and beyond.
template <class Real>
Real exponential_openness(Real distance, Real radius) {
  if (distance >= radius) return Real{1};
  constexpr Real kRate = static_cast<Real>(kOpennessRate);
  return std::expm1(-kRate * distance / radius) / std::expm1(-kRate);
}

/// What a texel sees in one direction, for the ambient transfer.
template <class Real>
struct Occluder {
  Real form_factor;  ///< share of the cosine-weighted hemisphere
  Real openness;     ///< μ in [0, 1]; 0 for a surface that hides the sky altogether
  Real albedo;       ///< where it is hit
};

/// Umenhoffer et al. 2009, eqs. 5 and 6: O/(1 − Σ F (1 − μ) ρ), with the obscurance O = A + Σ F μ. With μ = 0
/// and one albedo it is uniform_neighbourhood. `occluders`: any range of Occluder<Real> whose form factors
/// sum to 1 − A. 1 where it is 0/0, as there.
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

// G, from A and what is seen
// ---------------------------------------------------------------------------------------

inline constexpr FormText kBouncedText{"seen_stored", "A + rho (1 - A) n/(1 - rho (1 - n))", "here",
                                       R"(float heightlight_bounced(float sky, float seen, float albedo) {
  float a = heightlight_share(sky);
  float n = heightlight_share(seen);
  float rest = (1.0 - albedo) + albedo * n;
  if (rest <= 0.0) { return 1.0; }
  return a + (1.0 - a) * (albedo * n / rest);
}
)"};

/// The same for a texture whose two channels are A and n, as `ao-n` maps hold them, at an albedo of three
/// channels.
inline constexpr const char* kStoredPairShader = R"(vec3 multi_bounce(vec2 a_n, vec3 albedo) {
  return vec3(heightlight_bounced(a_n.x, a_n.y, albedo.x), heightlight_bounced(a_n.x, a_n.y, albedo.y),
              heightlight_bounced(a_n.x, a_n.y, albedo.z));
}
)";

/// What such a pair of channels means, for whoever reads them.
inline constexpr const char* kStoredPairMeaning =
    "A = (1/pi) int V cos(theta) dw, and n, solved for at albedo 0.7: E/pi at any albedo r is "
    "A + r (1 - A) n / (1 - r (1 - n))";

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
  const Real a = clamp_share(sky.value);
  const Real missing = albedo * (1 - total);        // ρ(1 − q)(1 − A)
  const Real brought = (1 - albedo) * (total - a);  // (1 − ρ) q (1 − A)
  return SeenSkyViewFactor<Real>(a >= 1 || brought >= missing ? Real{1} : clamp_share(brought / missing));
}

/// The albedo at which an n that is stored as a second channel is best solved for: there its error vanishes,
/// and is least from 0.3 to 0.9 all together.
inline constexpr double kSeenAlbedo = 0.7;

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
  const Real a = clamp_share(sky.value);
  if (a >= 1) return {a, a};
  const Real share = (total - a) / (1 - a);
  const Real q = share < 0 ? Real{0} : total_albedo < share ? total_albedo : share;
  const Real by_jensen = albedo <= 0 ? Real{0} : std::pow(q, std::log(albedo) / std::log(total_albedo));
  const Real by_chord = q * albedo / total_albedo;
  const bool chord_is_lower = by_chord < by_jensen;
  return {a + (1 - a) * (chord_is_lower ? by_chord : by_jensen),
          a + (1 - a) * (chord_is_lower ? by_jensen : by_chord)};
}

// Guesses of n
// -----------------------------------------------------------------------------------------------------

/// Guesses of n, as fitted to the maps of plots/make-models. Each keeps n in [0, 1].
struct SeenConstants {
  double offset = 0.07, slope = 0.82;                                  ///< from A alone
  double map_offset = 0.012, map_slope = 0.62, map_curvature = -0.17;  ///< from A and the map's s
  double deep_slope = 0.69, deep_bend = -0.65;                         ///< from A and the map's t
  double blur_offset = 0.013, blur_slope = 0.32;                       ///< from A and its blur
};

inline constexpr FormConstant<SeenConstants> kSeenConstants[] = {
    {"offset", &SeenConstants::offset},
    {"slope", &SeenConstants::slope},
    {"map_offset", &SeenConstants::map_offset},
    {"map_slope", &SeenConstants::map_slope},
    {"map_curvature", &SeenConstants::map_curvature},
    {"deep_slope", &SeenConstants::deep_slope},
    {"deep_bend", &SeenConstants::deep_bend},
    {"blur_offset", &SeenConstants::blur_offset},
    {"blur_slope", &SeenConstants::blur_slope}};

inline constexpr FormText kSeenFromSkyText{"seen_from_sky", "G(A, n, rho), n = offset + slope A", "here",
                                           R"(float heightlight_seen_from_sky(float sky) {
  return heightlight_share($offset + $slope * heightlight_share(sky));
}
)"};

/// n from A alone: offset + slope A.
template <class Real>
constexpr SeenSkyViewFactor<Real> guess_seen(SkyViewFactor<Real> sky, const SeenConstants& constants = {}) {
  return SeenSkyViewFactor<Real>(clamp_share(static_cast<Real>(constants.offset) +
                                             static_cast<Real>(constants.slope) * clamp_share(sky.value)));
}

inline constexpr FormText kSeenFromMapText{
    "seen_from_map", "G(A, n, rho), n = offset + s + slope (A - s) + curvature (A - s)^2", "here",
    R"(float heightlight_seen_from_map(float sky, float expected) {
  float s = heightlight_share(expected);
  float d = heightlight_share(sky) - s;
  return heightlight_share($map_offset + s + d * ($map_slope + d * ($map_curvature)));
}
)"};

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

inline constexpr FormText kSeenFromDeepText{"seen_from_deep", "G(A, n, rho), n = t + (slope + bend t) A",
                                            "here",
                                            R"(float heightlight_seen_from_deep(float sky, float deep) {
  return heightlight_share(deep + ($deep_slope + ($deep_bend) * deep) * heightlight_share(sky));
}
)"};

/// n from A and t = tune_deep_seen(…), one number per map: t + (slope + bend t) A.
template <class Real>
constexpr SeenSkyViewFactor<Real> guess_seen_in_deep(SkyViewFactor<Real> sky, SeenSkyViewFactor<Real> deep,
                                                     const SeenConstants& constants = {}) {
  const Real t = deep.value;
  return SeenSkyViewFactor<Real>(
      clamp_share(t + (static_cast<Real>(constants.deep_slope) + static_cast<Real>(constants.deep_bend) * t) *
                          clamp_share(sky.value)));
}

/// The blur with which n is guessed best on the maps of plots/make-models, in texels.
inline constexpr double kBlurSigma = 1.5;

inline constexpr FormText kSeenFromBlurText{"seen_from_blur", "G(A, n, rho), n = offset + W + slope (A - W)",
                                            "here",
                                            R"(float heightlight_seen_from_blur(float sky, float blurred) {
  float w = heightlight_share(blurred);
  return heightlight_share($blur_offset + w + $blur_slope * (heightlight_share(sky) - w));
}
)"};

/// n from A and its blurred neighbourhood W = blur_seen(…): offset + W + slope (A − W).
template <class Real>
constexpr SeenSkyViewFactor<Real> guess_seen_by_blur(SkyViewFactor<Real> sky, SeenSkyViewFactor<Real> blurred,
                                                     const SeenConstants& constants = {}) {
  const Real w = clamp_share(blurred.value);
  return SeenSkyViewFactor<Real>(
      clamp_share(static_cast<Real>(constants.blur_offset) + w +
                  static_cast<Real>(constants.blur_slope) * (clamp_share(sky.value) - w)));
}

}  // namespace heightlight
