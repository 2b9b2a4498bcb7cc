#pragma once

#include <cmath>

// Closed forms of the total irradiance E/π (unoccluded = 1) after all bounces, under a sky of radiance 1 and
// at the same albedo ρ everywhere, from the AO of a texel and what else is known of it. This file needs C++17
// and <cmath> and nothing else, so that an engine may take it alone. All functions are pure and take float or
// double. For a coloured albedo, call them once per channel. Every AO is a type of its own, so that a form
// never gets the wrong kind: AmbientOcclusion{0.5} and SkyViewFactor{0.5} do not convert into each other, nor
// from numbers.
//
// Arguments lie in [0, 1]. An AO that rounding or measurement put outside is clamped. A NaN argument gives
// NaN. A form gives NaN outside its domain, too.
//
// Each form is stated here and nowhere else: its function, its constants, and beside them its name, its
// formula and source in words, and its text as a shader function. Evaluation, fits, plots and emitted shaders
// take them from here. Shader text is written in the part of GLSL that can be printed in every shading
// language (see shaders.h); $name stands for the constant of that name.

namespace heightlight {

/// The words about a form, and its shader text.
struct FormText {
  const char* name;     ///< as it stands in tables, snake_case
  const char* formula;  ///< plain ASCII
  const char* source;   ///< paper and equation, or "here"
  const char* shader;   ///< GLSL functions, the last of which is the form; empty where it has none
};

/// A constant of a form that a fit may change: its name in shaders, and the member that holds it.
template <class Constants>
struct FormConstant {
  const char* name;
  double Constants::*value;
};

/// α, the share of the hemisphere's solid angle that sees the sky, in [0, 1]: the AO of the notes (Patapom).
template <class Real>
struct AmbientOcclusion {
  constexpr explicit AmbientOcclusion(Real share) : value(share) {}
  Real value;
};

/// A = E₀/π, the cosine-weighted share of the hemisphere that sees the sky, in [0, 1]: the AO of Jimenez et
/// al. 2016 and Umenhoffer et al. 2009.
template <class Real>
struct SkyViewFactor {
  constexpr explicit SkyViewFactor(Real share) : value(share) {}
  Real value;
};

/// n, the mean sky view factor of what a texel sees of the surface, weighted by form factors, in [0, 1].
/// Measured on a simulation it is E₁/π ÷ (1 − A) at ρ = 1.
template <class Real>
struct SeenSkyViewFactor {
  constexpr explicit SeenSkyViewFactor(Real share) : value(share) {}
  Real value;
};

/// Clamps a share to [0, 1], which measured shares leave by rounding. NaN stays NaN.
template <class Real>
constexpr Real clamp_share(Real share) {
  return share < Real{0} ? Real{0} : Real{1} < share ? Real{1} : share;
}

/// clamp_share as a shader function.
inline constexpr const char* kShareShader = R"(float heightlight_share(float x) {
  return min(max(x, 0.0), 1.0);
}
)";

// The direct irradiance, taken for the total
// ----------------------------------------------------------------------

inline constexpr FormText kDirectText{"direct", "A", "AO x pi", ""};
inline constexpr FormText kDirectAlphaText{"direct_alpha", "alpha", "Patapom, eq. 4", ""};

/// "AO × π": returns E/π = A at any ρ, as if there were no bounces. Exact at ρ = 0.
template <class Real>
constexpr Real direct_irradiance(SkyViewFactor<Real> sky) {
  return clamp_share(sky.value);
}

/// "AO × π" with α in place of A: returns E/π = α at any ρ (Patapom, eq. 4). Not exact even at ρ = 0.
template <class Real>
constexpr Real direct_irradiance(AmbientOcclusion<Real> occlusion) {
  return clamp_share(occlusion.value);
}

// The notes' F₀, F₁ and τ (Patapom)
// -------------------------------------------------------------------------------

/// Constants of the notes' form (Patapom, eqs. 7 and 11). The defaults are those published.
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

/// The last step of the notes' form, whatever its constants: F₀ + ρ F₁/(1 − ρτ), summed as
/// sum_bounces_guarded does.
inline constexpr const char* kBounceSumShader =
    R"(float heightlight_bounce_sum(float direct, float first, float albedo) {
  float missing = 1.0 - direct;
  float brought = albedo * first;
  float rest = (1.0 - albedo) * missing + brought;
  if (missing <= 0.0 || rest <= 0.0) { return 1.0; }
  return direct + missing * (brought / rest);
}
)";

/// Returns F₀: E₀/π as a function of α (Patapom, eq. 7). With the published constants it exceeds 1, by up to
/// 0.0062, where α > 0.9493.
template <class Real>
Real notes_direct(AmbientOcclusion<Real> occlusion, const NotesConstants& constants = {}) {
  const Real a = clamp_share(occlusion.value);
  return a * (1 + static_cast<Real>(constants.direct_gain) *
                      std::pow(1 - a, static_cast<Real>(constants.direct_power)));
}

/// Returns F₁: E₁/π at ρ = 1 as a function of α (Patapom, eq. 11).
template <class Real>
Real notes_first_bounce(AmbientOcclusion<Real> occlusion, const NotesConstants& constants = {}) {
  const Real a = clamp_share(occlusion.value);
  return static_cast<Real>(constants.first_gain) * a * (1 - a) * std::sqrt(1 - a) *
         std::exp(-static_cast<Real>(constants.first_decay) * std::sqrt(std::sqrt(a)));
}

/// Returns τ = 1 − F₁/(1 − F₀), the ratio of each bounce to the one before it (Patapom, eq. 9). With the
/// published constants it is negative for α > 0.764. NaN where F₀ ≥ 1, since no geometric series then sums to
/// 1.
template <class Real>
Real notes_ratio(AmbientOcclusion<Real> occlusion, const NotesConstants& constants = {}) {
  const Real missing = 1 - notes_direct(occlusion, constants);
  if (missing <= 0) return static_cast<Real>(NAN);
  return 1 - notes_first_bounce(occlusion, constants) / missing;
}

/// Returns the sum of all bounces, F₀ + ρ F₁/(1 − ρτ) (Patapom, eqs. 10 and 12), from F₀, F₁ and ρ. With eq.
/// 9 for τ it is
///     F₀ + ρ F₁ (1 − F₀)/((1 − ρ)(1 − F₀) + ρ F₁),
/// which loses no digits where F₀ comes near 1. Within its domain it lies in [0, 1], rises with ρ and is 1 at
/// ρ = 1. NaN outside: where F₀ ≥ 1, and where no bounce brings anything at ρ = 1 (ρτ = 1).
template <class Real>
constexpr Real sum_bounces(Real direct, Real first, Real albedo) {
  const Real missing = 1 - direct;
  if (missing <= 0) return static_cast<Real>(NAN);
  const Real brought = albedo * first;
  const Real rest = (1 - albedo) * missing + brought;
  if (rest <= 0) return static_cast<Real>(NAN);
  return direct + missing * (brought / rest);  // in this order the sum is never above 1
}

/// Returns E/π of the notes' form: sum_bounces of notes_direct and notes_first_bounce. With the published
/// constants it is NaN for α > 0.9493 (α = 1 included), and for α = 0 at ρ = 1.
template <class Real>
Real notes_total(AmbientOcclusion<Real> occlusion, Real albedo, const NotesConstants& constants = {}) {
  return sum_bounces(notes_direct(occlusion, constants), notes_first_bounce(occlusion, constants), albedo);
}

/// As sum_bounces, but with a value everywhere, as a renderer needs it: 1 where F₀ ≥ 1 (nearly open, and
/// already full) and where ρτ = 1 (at ρ = 1 all totals are 1). NaN only if an argument is NaN.
template <class Real>
Real sum_bounces_guarded(Real direct, Real first, Real albedo) {
  const Real total = sum_bounces(direct, first, albedo);
  return std::isnan(total) && !std::isnan(direct + first + albedo) ? Real{1} : total;
}

/// As notes_total, but summed by sum_bounces_guarded: 1 outside the form's domain, and NaN only if an
/// argument is NaN.
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

/// Returns E/π = A/(1 − ρ(1 − A)) (Jimenez et al. 2016, eq. 12). The form assumes that what a place sees is
/// as bright as the place itself. At A = 0, ρ = 1, where it is 0/0, it is 1, as it is along all of ρ = 1.
template <class Real>
constexpr Real uniform_neighbourhood(SkyViewFactor<Real> sky, Real albedo) {
  const Real a = clamp_share(sky.value);
  const Real rest = (1 - albedo) + albedo * a;  // 1 − ρ(1 − A), without cancellation near (0, 1)
  return rest <= 0 ? Real{1} : a / rest;
}

/// Coefficients of Jimenez' cubic a A³ − b A² + c A, each linear in ρ (Jimenez et al. 2016, eq. 33). The
/// defaults are those published, which were fitted to three bounces at ρ = 0.1 … 0.9.
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

/// Returns the polynomial of eq. 33 without clamping: it may leave [0, 1].
template <class Real>
constexpr Real cubic_polynomial(SkyViewFactor<Real> sky, Real albedo, const CubicConstants& constants = {}) {
  const Real a3 = static_cast<Real>(constants.a_slope) * albedo + static_cast<Real>(constants.a_offset);
  const Real a2 = static_cast<Real>(constants.b_slope) * albedo + static_cast<Real>(constants.b_offset);
  const Real a1 = static_cast<Real>(constants.c_slope) * albedo + static_cast<Real>(constants.c_offset);
  const Real a = clamp_share(sky.value);
  return ((a3 * a - a2) * a + a1) * a;
}

/// Returns E/π by the cubic of Jimenez et al. 2016, eq. 33, clamped to [0, 1]. With the published constants
/// it is below A at ρ = 0, by up to 0.044, and is not 1 at ρ = 1 (0.90 at A = 0.5). Without the clamp it
/// would exceed 1 by up to 10⁻⁴ near A = 1.
template <class Real>
constexpr Real cubic_total(SkyViewFactor<Real> sky, Real albedo, const CubicConstants& constants = {}) {
  return clamp_share(cubic_polynomial(sky, albedo, constants));
}

// Ambient transfer (Umenhoffer et al. 2009)
// --------------------------------------------------------------------------------------

/// Returns μ of Umenhoffer et al. 2009, section 3: the openness, in [0, 1], of a surface at `distance` ≥ 0.
/// It is √(d/R) up to the radius R > 0, and 1 beyond. Both lengths are in the same unit.
template <class Real>
Real fuzzy_openness(Real distance, Real radius) {
  return distance >= radius ? Real{1} : std::sqrt(distance / radius);
}

/// Rate of the exponential μ: σ R, the number of mean free paths up to the radius.
inline constexpr double kOpennessRate = 4;

/// Returns the exponential μ of Umenhoffer et al. 2009, section 2: 1 − exp(−σ d). Its authors abandon it
/// because it has no end. Here σ is kOpennessRate/R, and μ is scaled to be 1 at the radius R > 0 and beyond.
/// The arguments are those of fuzzy_openness.
template <class Real>
Real exponential_openness(Real distance, Real radius) {
  if (distance >= radius) return Real{1};
  constexpr Real kRate = static_cast<Real>(kOpennessRate);
  return std::expm1(-kRate * distance / radius) / std::expm1(-kRate);
}

/// What a texel sees in one direction, as ambient_transfer needs it.
template <class Real>
struct Occluder {
  Real form_factor;  ///< form factor: share of the cosine-weighted hemisphere that it covers
  Real openness;     ///< μ in [0, 1]; 0 for a surface that hides the sky completely
  Real albedo;       ///< albedo of the place that is seen, in [0, 1]
};

/// Returns E/π = O/(1 − Σ F (1 − μ) ρ) with the obscurance O = A + Σ F μ (Umenhoffer et al. 2009, eqs. 5 and
/// 6), in [0, 1]. `occluders` is any range of Occluder<Real> whose form factors sum to 1 − A. With μ = 0 and
/// one albedo the form is uniform_neighbourhood. Where it is 0/0, it is 1, as uniform_neighbourhood is.
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

/// heightlight_bounced for a texture whose two channels are A and n, as `ao-n` maps hold them, at an albedo
/// of three channels.
inline constexpr const char* kStoredPairShader = R"(vec3 multi_bounce(vec2 a_n, vec3 albedo) {
  return vec3(heightlight_bounced(a_n.x, a_n.y, albedo.x), heightlight_bounced(a_n.x, a_n.y, albedo.y),
              heightlight_bounced(a_n.x, a_n.y, albedo.z));
}
)";

/// The meaning of such a pair of channels, in words for its readers.
inline constexpr const char* kStoredPairMeaning =
    "A = (1/pi) int V cos(theta) dw, and n, solved for at albedo 0.7: E/pi at any albedo r is "
    "A + r (1 - A) n / (1 - r (1 - n))";

/// Returns E/π = G(A, n, ρ) = A + ρ(1 − A) n/(1 − ρ(1 − n)). The first bounce brings ρ(1 − A)n, and every
/// later one ρ(1 − n) of the one before, which is the ratio that lets all of them sum to 1 at ρ = 1. The form
/// is exact at ρ = 0 and ρ = 1, has no poles, lies in [0, 1], and rises with ρ and with n. At n = 0, ρ = 1,
/// where it is 0/0, it is 1, as it is along all of ρ = 1. With n = A it is uniform_neighbourhood.
template <class Real>
constexpr Real bounced_total(SkyViewFactor<Real> sky, SeenSkyViewFactor<Real> seen, Real albedo) {
  const Real a = clamp_share(sky.value);
  const Real n = clamp_share(seen.value);
  const Real rest = (1 - albedo) + albedo * n;
  return rest <= 0 ? Real{1} : a + (1 - a) * (albedo * n / rest);
}

/// Returns the n, in [0, 1], with which bounced_total gives `total` (E/π) at `albedo`, 0 < albedo < 1. With q
/// = (G − A)/(1 − A) it is n = q(1 − ρ)/(ρ(1 − q)), clamped. Where nothing is seen (A = 1) any n gives the
/// total; the result is 1 there.
template <class Real>
constexpr SeenSkyViewFactor<Real> seen_from_total(SkyViewFactor<Real> sky, Real total, Real albedo) {
  const Real a = clamp_share(sky.value);
  const Real missing = albedo * (1 - total);        // ρ(1 − q)(1 − A)
  const Real brought = (1 - albedo) * (total - a);  // (1 − ρ) q (1 − A)
  return SeenSkyViewFactor<Real>(a >= 1 || brought >= missing ? Real{1} : clamp_share(brought / missing));
}

/// The albedo at which an n that is stored as a second channel is best solved for: the error of bounced_total
/// then vanishes at this albedo, and is least over all albedos from 0.3 to 0.9 together.
inline constexpr double kSeenAlbedo = 0.7;

/// The interval [low, high] that E/π lies in.
template <class Real>
struct TotalBounds {
  Real low;
  Real high;
};

/// Returns bounds of E/π at `albedo` that hold on any surface, from A and `total`, which is E/π at another
/// albedo ρ₀ = `total_albedo`, 0 < ρ₀ < 1. Derivation: bounces bring f(ρ) = Σ_{b ≥ 1} E_b ρ^b, where no E_b
/// is negative and f(1) = 1 − A. Let q = f(ρ₀)/f(1), which is the mean of ρ₀^b weighted by E_b. One bound is
/// q^γ, by Jensen's inequality for ρ^b = (ρ₀^b)^γ with γ = ln ρ/ln ρ₀. The other is q ρ/ρ₀, from the chord of
/// that power from 0 to ρ₀. bounced_total lies between the bounds, too.
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

/// Constants of the functions that guess n, as fitted to the maps of plots/make-models. Each guess is clamped
/// to [0, 1].
struct SeenConstants {
  double offset = 0.07, slope = 0.82;  ///< of guess_seen
  double map_offset = 0.012, map_slope = 0.62,
         map_curvature = -0.17;                   ///< of guess_seen_on_map
  double deep_slope = 0.69, deep_bend = -0.65;    ///< of guess_seen_in_deep
  double blur_offset = 0.013, blur_slope = 0.32;  ///< of guess_seen_by_blur
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

/// Guesses n from A alone: offset + slope A, clamped to [0, 1].
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

/// Guesses n from A and one number per map, s = expected_seen(…): offset + s + slope (A − s) + curvature (A −
/// s)², clamped to [0, 1].
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

/// Guesses n from A and one number per map, t = tune_deep_seen(…): t + (slope + bend t) A, clamped to [0, 1].
template <class Real>
constexpr SeenSkyViewFactor<Real> guess_seen_in_deep(SkyViewFactor<Real> sky, SeenSkyViewFactor<Real> deep,
                                                     const SeenConstants& constants = {}) {
  const Real t = deep.value;
  return SeenSkyViewFactor<Real>(
      clamp_share(t + (static_cast<Real>(constants.deep_slope) + static_cast<Real>(constants.deep_bend) * t) *
                          clamp_share(sky.value)));
}

/// The σ of the blur, in texels, with which guess_seen_by_blur is best on the maps of plots/make-models.
inline constexpr double kBlurSigma = 1.5;

inline constexpr FormText kSeenFromBlurText{"seen_from_blur", "G(A, n, rho), n = offset + W + slope (A - W)",
                                            "here",
                                            R"(float heightlight_seen_from_blur(float sky, float blurred) {
  float w = heightlight_share(blurred);
  return heightlight_share($blur_offset + w + $blur_slope * (heightlight_share(sky) - w));
}
)"};

/// Guesses n from A and the blurred sky view factor W = blur_seen(…): offset + W + slope (A − W), clamped to
/// [0, 1].
template <class Real>
constexpr SeenSkyViewFactor<Real> guess_seen_by_blur(SkyViewFactor<Real> sky, SeenSkyViewFactor<Real> blurred,
                                                     const SeenConstants& constants = {}) {
  const Real w = clamp_share(blurred.value);
  return SeenSkyViewFactor<Real>(
      clamp_share(static_cast<Real>(constants.blur_offset) + w +
                  static_cast<Real>(constants.blur_slope) * (clamp_share(sky.value) - w)));
}

}  // namespace heightlight
