#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "heightlight/forms.h"

// Closed forms that shade with an ambient occlusion which knows a direction: diffuse light of a sky that is
// not the same all over, and what a glossy lobe sees. Like forms.h this file needs C++17 and the standard
// library's mathematics and nothing else, so that an engine may take both alone. Pure functions, of float or
// double. Each form is stated here and nowhere else, beside its text as a shader function, in the part of
// GLSL that is printed in every shading language (shaders.h tells it); $name stands for a constant.
//
// Directions are unit vectors in axes of the caller's, the same for all arguments of a call. Angles are in
// radians.
//
// Roughness is α of the GGX distribution itself (Walter et al. 2007, eq. 33), in (0, 1]: the square of what
// many engines call by that name.

namespace heightlight {

inline constexpr double kPiOfForms = 3.14159265358979323846;

/// A vector, unit where it is a direction.
template <class Real>
struct Direction {
  Real x{};
  Real y{};
  Real z{};
};

template <class Real>
constexpr Real dot(const Direction<Real>& a, const Direction<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Real>
constexpr Direction<Real> cross(const Direction<Real>& a, const Direction<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Rounding takes cosines a hair out of [−1, 1].
template <class Real>
Real angle_of_cosine(Real cosine) {
  using std::acos;
  return acos(cosine < Real(-1) ? Real(-1) : Real(1) < cosine ? Real(1) : cosine);
}

// The cone that stands for what is open
// ---------------------------------------------------------------------------------

/// cos α_v of the cone of half-angle α_v that is as open: A = 1 − cos²α_v (Jimenez 2016, eqs. 22, 31 and 32).
template <class Real>
Real cone_cosine(SkyViewFactor<Real> sky) {
  using std::sqrt;
  return sqrt(Real(1) - clamp_share(sky.value));
}

// Diffuse light in nine spherical harmonics
// ----------------------------------------------------------------------------

/// Coefficients over the nine real spherical harmonics of l ≤ 2, in the order Y00, Y1−1, Y10, Y11, Y2−2,
/// Y2−1, Y20, Y21, Y22: orthonormal, without the Condon–Shortley phase, z the pole.
template <class Real>
using NineHarmonics = std::array<Real, 9>;

/// The mean of Y_lm over weights whose moments are known: of 1 (`share`), of ω, and of x² − y², xy, z², xz,
/// yz.
template <class Real>
NineHarmonics<Real> harmonics_from_moments(Real share, const Direction<Real>& first,
                                           const std::array<Real, 5>& second) {
  const Real y0(0.28209479177387814);   // 1/(2 √π)
  const Real y1(0.48860251190291992);   // √(3/(4π))
  const Real y2(1.0925484305920792);    // √(15/(4π))
  const Real y20(0.31539156525252005);  // √(5/(16π))
  const Real y22(0.54627421529603959);  // √(15/(16π))
  return {y0 * share,
          y1 * first.y,
          y1 * first.z,
          y1 * first.x,
          y2 * second[1],
          y2 * second[4],
          y20 * (Real(3) * second[2] - share),
          y2 * second[3],
          y22 * second[0]};
}

/// Y_lm of a direction.
template <class Real>
NineHarmonics<Real> harmonics_along(const Direction<Real>& d) {
  return harmonics_from_moments(Real(1), d,
                                {d.x * d.x - d.y * d.y, d.x * d.y, d.z * d.z, d.x * d.z, d.y * d.z});
}

/// Σ a b.
template <class Real>
Real dot(const NineHarmonics<Real>& a, const NineHarmonics<Real>& b) {
  Real sum(0);
  for (std::size_t i = 0; i < a.size(); ++i) sum = sum + a[i] * b[i];
  return sum;
}

/// z_l, l ≤ 2, of a cone whose directions all count the same: ∫ Y_l0 dω over it, of the cosine of its
/// half-angle in [0, 1].
template <class Real>
std::array<Real, 3> cap_zonal_harmonics(Real cosine) {
  const Real sine_squared = Real(1) - cosine * cosine;
  return {Real(1.7724538509055161) * (Real(1) - cosine),      // √π
          Real(1.5349900619197328) * sine_squared,            // √(3π)/2
          Real(1.9816636488030057) * cosine * sine_squared};  // √(5π)/2
}

/// Coefficients, each times the factor of its band l = 0, 1, 2.
template <class Real>
NineHarmonics<Real> scale_bands(const std::array<Real, 3>& factors, NineHarmonics<Real> harmonics) {
  for (std::size_t i = 0; i < harmonics.size(); ++i)
    harmonics[i] = factors[i == 0 ? 0 : i < 4 ? 1 : 2] * harmonics[i];
  return harmonics;
}

/// Coefficients of what is symmetric about an axis: √(4π/(2l + 1)) z_l Y_lm(axis) (Jimenez 2016, eq. 17).
template <class Real>
NineHarmonics<Real> turn_zonal(const std::array<Real, 3>& zonal, const Direction<Real>& axis) {
  const std::array<Real, 3> scale = {Real(3.5449077018110318) * zonal[0], Real(2.0466534158929770) * zonal[1],
                                     Real(1.5853309190424043) * zonal[2]};  // √(4π), √(4π/3), √(4π/5)
  return scale_bands<Real>(scale, harmonics_along(axis));
}

/// What the cone of visibility about the bent normal passes of each band l = 0, 1, 2 of a sky's harmonics, so
/// that
///     E/π = Σ_l passes_l Σ_m L_lm Y_lm(bent normal):
/// the sums over m are the sky's own bands as seen toward the bent normal, whatever basis they are stored in.
/// The cone is as open as A, its cosine taken about its axis. With c its half-angle's cosine, the zonal
/// harmonics ∫ Y_l0 cosθ dω turned, √(4π/(2l + 1)) z_l/π (Jimenez 2016, eqs. 17, 22 and 23), are
///     A,  2/3 (1 − c³),  A (1 + 3 c²)/4,
/// where 1 − c³ = A (1 + c + c²)/(1 + c) loses no digits as A goes to 0. Of an open place: 1, 2/3, 1/4.
template <class Real>
std::array<Real, 3> cone_bands(SkyViewFactor<Real> sky) {
  const Real a = clamp_share(sky.value);
  const Real c = cone_cosine(sky);
  const Real squared = Real(1) - a;
  return {a, Real(2.0 / 3.0) * (a * ((Real(1) + c + squared) / (Real(1) + c))),
          Real(0.25) * (a * (Real(1) + Real(3) * squared))};
}

inline constexpr const char* kConeBandsShader = R"(vec3 heightlight_cone_bands(float sky) {
  float a = heightlight_share(sky);
  float squared = 1.0 - a;
  float c = sqrt(squared);
  return vec3(a, 0.666666667 * (a * ((1.0 + c + squared) / (1.0 + c))), 0.25 * (a * (1.0 + 3.0 * squared)));
}
)";

/// The same as coefficients, as `bake --maps sh` has them: E/π under a sky is their dot product with the
/// sky's.
template <class Real>
NineHarmonics<Real> cone_harmonics(SkyViewFactor<Real> sky, const Direction<Real>& bent_normal) {
  return scale_bands(cone_bands(sky), harmonics_along(bent_normal));
}

/// Nine numbers of a shader's are two vectors of four and the last.
inline constexpr const char* kConeHarmonicsShader[] = {
    R"(vec4 heightlight_cone_sh_0_to_3(float sky, vec3 axis) {
  vec3 bands = heightlight_cone_bands(sky);
  return vec4(0.282094792 * bands.x, 0.488602512 * bands.y * axis.y, 0.488602512 * bands.y * axis.z,
              0.488602512 * bands.y * axis.x);
}
)",
    R"(vec4 heightlight_cone_sh_4_to_7(float sky, vec3 axis) {
  vec3 bands = heightlight_cone_bands(sky);
  return bands.z * vec4(1.09254843 * axis.x * axis.y, 1.09254843 * axis.y * axis.z,
                        0.946174696 * axis.z * axis.z - 0.315391565, 1.09254843 * axis.x * axis.z);
}
)",
    R"(float heightlight_cone_sh_8(float sky, vec3 axis) {
  vec3 bands = heightlight_cone_bands(sky);
  return 0.546274215 * bands.z * (axis.x * axis.x - axis.y * axis.y);
}
)"};

/// E/π under a sky of nine coefficients, from a bent normal and its A (directional GTAO, Jimenez 2016, eqs.
/// 16, 17, 22 and 23). With the normal and A = 1 it is what an open plane receives. Harmonics ring: it may be
/// a little below 0.
template <class Real>
Real directional_irradiance(const NineHarmonics<Real>& sky_light, SkyViewFactor<Real> sky,
                            const Direction<Real>& bent_normal) {
  return dot(sky_light, cone_harmonics(sky, bent_normal));
}

/// Of one channel.
inline constexpr const char* kDirectionalShader =
    R"(float heightlight_directional_irradiance(vec4 light_0_to_3, vec4 light_4_to_7, float light_8, float sky, vec3 axis) {
  return dot(light_0_to_3, heightlight_cone_sh_0_to_3(sky, axis)) +
         dot(light_4_to_7, heightlight_cone_sh_4_to_7(sky, axis)) + light_8 * heightlight_cone_sh_8(sky, axis);
}
)";

// What a glossy lobe sees of the sky
// -----------------------------------------------------------------------------------

/// ∫ dω of a cone of half-angle a in [0, π], sr.
template <class Real>
Real cap_solid_angle(Real half_angle) {
  using std::sin;
  const Real sine = sin(half_angle / Real(2));  // 1 − cos a without cancellation
  return Real(4 * kPiOfForms) * sine * sine;
}

/// Solid angle, sr, that two cones of half-angles a and b in [0, π/2] share whose axes are d apart, in [0,
/// π]. Where the circles cross, each axis sees the crossings a turn 2φ apart, and axes and crossings make two
/// spherical triangles of sides a, b, d and of excess E each: the sectors of both caps cover the triangles
/// twice, so that the lens is
///     2 φ_a (1 − cos a) + 2 φ_b (1 − cos b) − 2 E.
/// Angles are found from their halves, which loses no digits where circles touch or a cone is narrow.
template <class Real>
Real shared_solid_angle(Real a, Real b, Real d) {
  using std::atan2;
  using std::sin;
  using std::sqrt;
  using std::tan;
  const Real smaller = a < b ? a : b;
  if (!(d < a + b)) return Real(0);
  if (!(a + b - Real(2) * smaller < d)) return cap_solid_angle(smaller);
  const Real half = Real(0.5) * (a + b + d);
  const Real whole = sin(half);
  const Real beyond_a = sin(half - a), beyond_b = sin(half - b), beyond_d = sin(half - d);
  const auto root = [](Real square) { return sqrt(square < Real(0) ? Real(0) : square); };
  const Real turn_a = Real(2) * atan2(root(beyond_a * beyond_d), root(whole * beyond_b));
  const Real turn_b = Real(2) * atan2(root(beyond_b * beyond_d), root(whole * beyond_a));
  const Real tangents = tan(Real(0.5) * a) * tan(Real(0.5) * b);
  const Real near = beyond_a * beyond_b;
  const Real far = whole * beyond_d;
  const Real excess =
      Real(2) * atan2(Real(2) * tangents * root(near * far), near + far + tangents * (far - near));
  const Real shared =
      (turn_a * cap_solid_angle(a) + turn_b * cap_solid_angle(b)) / Real(kPiOfForms) - Real(2) * excess;
  return shared < Real(0) ? Real(0) : shared;
}

inline constexpr const char* kSharedSolidAngleShader =
    R"(float heightlight_shared_solid_angle(float a, float b, float d) {
  float sine_a = sin(0.5 * a);
  float sine_b = sin(0.5 * b);
  float smaller = min(sine_a, sine_b);
  if (d >= a + b) { return 0.0; }
  if (d <= abs(a - b)) { return 12.5663706 * smaller * smaller; }
  float around = 0.5 * (a + b + d);
  float short_of = 0.5 * ((1.57079633 - a) + (1.57079633 - b) + (3.14159265 - d));
  float whole = sin(min(around, short_of));
  float beyond_a = sin(0.5 * (b + d - a));
  float beyond_b = sin(0.5 * (a + d - b));
  float beyond_d = sin(0.5 * (a + b - d));
  float turn_a = atan2(sqrt(max(beyond_a * beyond_d, 0.0)), sqrt(max(whole * beyond_b, 0.0)));
  float turn_b = atan2(sqrt(max(beyond_b * beyond_d, 0.0)), sqrt(max(whole * beyond_a, 0.0)));
  float tangents = tan(0.5 * a) * tan(0.5 * b);
  float near = beyond_a * beyond_b;
  float far = whole * beyond_d;
  float excess = atan2(2.0 * tangents * sqrt(max(near * far, 0.0)), near + far + tangents * (far - near));
  return max(8.0 * (turn_a * sine_a * sine_a + turn_b * sine_b * sine_b) - 4.0 * excess, 0.0);
}
)";

/// u of the cone that stands for a lobe.
struct LobeConeConstants {
  double share = 0.01;  ///< as published, for Phong's lobe (Jimenez 2016, appendix C)
};

/// Half-angle of the cone that stands for a lobe: cos α_s = u^(1/(p + 2)), with Phong's power p = 2/r² − 2
/// that Walter et al. 2007 relate to the roughness r, so that cos α_s = u^(r²/2) (Jimenez 2016, eq. 35).
template <class Real>
Real lobe_cone(Real roughness, const LobeConeConstants& constants = {}) {
  using std::pow;
  return angle_of_cosine(pow(static_cast<Real>(constants.share), roughness * roughness / Real(2)));
}

/// Cone against cone: of the lobe's cone about the mirrored view, the share that the cone of openness covers
/// (Jimenez 2016, eqs. 34 and 35). `apart` is the angle between the bent normal and the mirrored view.
template <class Real>
Real cone_cone_occlusion(SkyViewFactor<Real> sky, Real apart, Real roughness,
                         const LobeConeConstants& constants = {}) {
  const Real lobe = lobe_cone(roughness, constants);
  const Real open = angle_of_cosine(cone_cosine(sky));
  const Real share = shared_solid_angle(open, lobe, apart) / cap_solid_angle(lobe);
  return Real(1) < share ? Real(1) : share;
}

inline constexpr const char* kConeConeShader =
    R"(float heightlight_cone_cone(float sky, float apart, float roughness) {
  float a = heightlight_share(sky);
  float open = atan2(sqrt(a), sqrt(1.0 - a));
  float r = min(max(roughness, 0.01), 1.0);
  float half_sine = sqrt(0.5 - 0.5 * pow($share, 0.5 * r * r));
  float lobe = 2.0 * atan2(half_sine, sqrt(1.0 - half_sine * half_sine));
  float shared_part = heightlight_shared_solid_angle(open, lobe, apart);
  return heightlight_share(shared_part / (12.5663706 * half_sine * half_sine));
}
)";

/// How GGX's lobe falls off across a straight edge so many of its widths away, from −1 to 1.
template <class Real>
Real lobe_falloff(Real widths) {
  using std::sqrt;
  return widths / sqrt(Real(1) + widths * widths);
}

inline constexpr const char* kFalloffShader = R"(float heightlight_falloff(float widths) {
  return widths * inversesqrt(1.0 + widths * widths);
}
)";

/// The second axis of GTSO's table (SpecularTable in gloss.h): how the lobe falls off toward the edge of the
/// cone, scaled so that angles from 0 to π between the cone's axis and the mirrored view are 0 to 1.
template <class Real>
struct TableApart {
  Real begin, span;
  Real half_angle, width;

  /// `roughness` > 0.
  TableApart(Real cone_half_angle, Real roughness) : half_angle(cone_half_angle), width(Real(2) * roughness) {
    begin = lobe_falloff(-half_angle / width);
    span = lobe_falloff((Real(kPiOfForms) - half_angle) / width) - begin;
  }

  Real place(Real apart) const { return (lobe_falloff((apart - half_angle) / width) - begin) / span; }
};

/// Where that table is to be read. It is a 3D texture of side × side × side² texels, whose layers run over
/// the roughness first, then over the view's angle: linear filtering of two places, mixed.
inline constexpr const char* kTablePlaceShader =
    R"(vec4 heightlight_table_place(float sky, float apart, float roughness, float view_cosine, float side) {
  float a = heightlight_share(sky);
  float cone = atan2(sqrt(a), sqrt(1.0 - a));
  float r = min(max(roughness, 0.005), 1.0);
  float begin = heightlight_falloff(-0.5 * cone / r);
  float span = heightlight_falloff((3.14159265 - cone) * 0.5 / r) - begin;
  float y = (heightlight_falloff((apart - cone) * 0.5 / r) - begin) / span;
  float c = heightlight_share(view_cosine);
  float view = atan2(sqrt((1.0 - c) * (1.0 + c)), c) * 0.636619772 * (side - 1.0);
  float layer = min(floor(view), side - 2.0) * side + sqrt(r) * (side - 1.0) + 0.5;
  return vec4((cone * 0.636619772 * (side - 1.0) + 0.5) / side, (y * (side - 1.0) + 0.5) / side,
              layer / (side * side), (layer + side) / (side * side));
}
)";
inline constexpr const char* kTableWeightShader =
    R"(float heightlight_table_weight(float view_cosine, float side) {
  float c = heightlight_share(view_cosine);
  float view = atan2(sqrt((1.0 - c) * (1.0 + c)), c) * 0.636619772 * (side - 1.0);
  return view - min(floor(view), side - 2.0);
}
)";

/// Lagarde's empirical form: (n·v + A)^(2^(−16 r − 1)) − 1 + A, cut to [0, 1] (Lagarde and de Rousiers 2014,
/// listing 26). It knows no direction but the view's.
template <class Real>
Real lagarde_occlusion(SkyViewFactor<Real> sky, Real view_cosine, Real roughness) {
  using std::exp2;
  using std::pow;
  const Real a = clamp_share(sky.value);
  const Real power = exp2(Real(-16) * roughness - Real(1));
  return clamp_share(pow(view_cosine + a, power) - Real(1) + a);
}

inline constexpr const char* kLagardeShader =
    R"(float heightlight_lagarde(float sky, float view_cosine, float roughness) {
  float a = heightlight_share(sky);
  return heightlight_share(pow(heightlight_share(view_cosine) + a, exp2(-16.0 * roughness - 1.0)) - 1.0 + a);
}
)";

// GGX
// -----------------------------------------------------------------------------------------------------------

/// Smith's G₁ of a direction by its cosine: 2/(1 + √(1 + r² tan²θ)) (Walter et al. 2007, eq. 34).
template <class Real>
Real smith_shadowing(Real roughness, Real cosine) {
  using std::sqrt;
  const Real squared = cosine * cosine;
  return Real(2) / (Real(1) + sqrt(Real(1) + roughness * roughness * (Real(1) - squared) / squared));
}

/// Fresnel's factor in Schlick's form, of the cosine between light and microfacet.
template <class Real>
Real schlick(Real reflectance, Real cosine) {
  const Real rest = Real(1) < cosine ? Real(0) : Real(1) - cosine;
  const Real squared = rest * rest;
  return reflectance + (Real(1) - reflectance) * squared * squared * rest;
}

/// Both of a direction of the lobe, of a reflectance of 0.04.
inline constexpr const char* kLobeWeightShader =
    R"(float heightlight_lobe_weight(float roughness, float light_cosine, float facet_cosine) {
  float r = min(max(roughness, 0.005), 1.0);
  float rest = 1.0 - heightlight_share(facet_cosine);
  float squared = light_cosine * light_cosine;
  float shadowing = 2.0 * light_cosine / (light_cosine + sqrt(squared + r * r * (1.0 - squared)));
  return (0.04 + 0.96 * rest * rest * rest * rest * rest) * shadowing;
}
)";

/// A direction that GGX mirrors the view into.
template <class Real>
struct GgxDirection {
  Direction<Real> direction;  ///< unit
  Real facet_cosine{};        ///< to the microfacet's normal
};

/// Of the point (u, v) of the unit square, by visible normals (Heitz 2018, section 3.2), in the normal's
/// frame: a point of a disc, half of which foreshortens with the view, is projected onto the hemisphere of
/// normals. Mirrored, their density is f_r cosθ but for Fresnel's factor, the light's shadowing, and a
/// constant. Where the direction lies below the surface, its z is negative.
template <class Real>
GgxDirection<Real> mirror_visible_normal(const Direction<Real>& view, Real roughness, Real u, Real v) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const Real stretched_x = roughness * view.x;
  const Real stretched_y = roughness * view.y;
  const Real flat = stretched_x * stretched_x + stretched_y * stretched_y;
  const Real scale = Real(1) / sqrt(flat + view.z * view.z);
  const Direction<Real> seen_from = {stretched_x * scale, stretched_y * scale, view.z * scale};
  const Real across_scale = Real(0) < flat ? Real(1) / sqrt(flat) : Real(0);
  const Direction<Real> across = Real(0) < flat ? Direction<Real>{(Real(0) - stretched_y) * across_scale,
                                                                  stretched_x * across_scale, Real(0)}
                                                : Direction<Real>{Real(1), Real(0), Real(0)};
  const Direction<Real> along = cross(seen_from, across);
  const Real radius = sqrt(u);
  const Real first = radius * cos(Real(2 * kPiOfForms) * v);
  const Real share = (Real(1) + seen_from.z) / Real(2);
  const Real rest = Real(1) - first * first;
  const Real second = (Real(1) - share) * sqrt(rest < Real(0) ? Real(0) : rest) +
                      share * radius * sin(Real(2 * kPiOfForms) * v);
  const Real last = rest - second * second;
  const Real third = sqrt(last < Real(0) ? Real(0) : last);
  const Real x = roughness * (first * across.x + second * along.x + third * seen_from.x);
  const Real y = roughness * (first * across.y + second * along.y + third * seen_from.y);
  const Real above = first * across.z + second * along.z + third * seen_from.z;
  const Real z = above < Real(1e-12) ? Real(1e-12) : above;
  const Real length = Real(1) / sqrt(x * x + y * y + z * z);
  const Direction<Real> normal = {x * length, y * length, z * length};
  const Real cosine = dot(view, normal);
  return {{Real(2) * cosine * normal.x - view.x, Real(2) * cosine * normal.y - view.y,
           Real(2) * cosine * normal.z - view.z},
          cosine};
}

/// Direction and facet_cosine.
inline constexpr const char* kLobeDirectionShader =
    R"(vec4 heightlight_lobe_direction(vec3 view, float roughness, float u, float v) {
  float r = min(max(roughness, 0.005), 1.0);
  vec3 seen = normalize(vec3(r * view.x, r * view.y, view.z));
  float level = sqrt(seen.x * seen.x + seen.y * seen.y);
  vec3 across = vec3(1.0, 0.0, 0.0);
  if (level > 0.0) { across = vec3(-seen.y / level, seen.x / level, 0.0); }
  vec3 along = cross(seen, across);
  float radius = sqrt(u);
  float x = radius * cos(6.28318531 * v);
  float share = 0.5 + 0.5 * seen.z;
  float y = (1.0 - share) * sqrt(max(1.0 - x * x, 0.0)) + share * radius * sin(6.28318531 * v);
  vec3 n = x * across + y * along + sqrt(max(1.0 - x * x - y * y, 0.0)) * seen;
  vec3 facet = normalize(vec3(r * n.x, r * n.y, max(n.z, 0.0)));
  float cosine = dot(view, facet);
  return vec4(2.0 * cosine * facet - view, cosine);
}
)";

/// Two unit vectors that complete a normal (z ≥ 0) to a right-handed frame (Duff et al. 2017).
template <class Real>
struct NormalFrame {
  Direction<Real> tangent, bitangent, normal;

  explicit NormalFrame(const Direction<Real>& n) : normal(n) {
    const Real a = Real(-1) / (Real(1) + n.z);
    const Real b = n.x * n.y * a;
    tangent = {Real(1) + n.x * n.x * a, b, Real(0) - n.x};
    bitangent = {b, Real(1) + n.y * n.y * a, Real(0) - n.y};
  }

  Direction<Real> into(const Direction<Real>& d) const {
    return {dot(d, tangent), dot(d, bitangent), dot(d, normal)};
  }
  Direction<Real> out_of(const Direction<Real>& d) const {
    return {d.x * tangent.x + d.y * bitangent.x + d.z * normal.x,
            d.x * tangent.y + d.y * bitangent.y + d.z * normal.y,
            d.x * tangent.z + d.y * bitangent.z + d.z * normal.z};
  }
};

inline constexpr const char* kTangentShader = R"(vec3 heightlight_tangent(vec3 normal) {
  float a = -1.0 / (1.0 + normal.z);
  return vec3(1.0 + normal.x * normal.x * a, normal.x * normal.y * a, -normal.x);
}
)";
inline constexpr const char* kBitangentShader = R"(vec3 heightlight_bitangent(vec3 normal) {
  float a = -1.0 / (1.0 + normal.z);
  return vec3(normal.x * normal.y * a, 1.0 + normal.y * normal.y * a, -normal.y);
}
)";

/// What GGX's visible normals make of a polygon of directions, vertex by vertex.
///
/// A direction ω shines into the view v by the normal h ∝ v + ω. In units of the roughness, N ∝ (h_x/r,
/// h_y/r, h_z) and v′ ∝ (r v_x, r v_y, v_z), the distribution of visible normals is that of a hemisphere seen
/// along v′ (Heitz 2018): N counts by N·v′. A polygon of N, whose sides are great circles, thus counts as
/// much as a Lambertian receiver facing v′ gets of it, which Lambert's formula tells in closed form: half the
/// sum over its sides of their angle times the cosine between the normals of their planes and v′. What is
/// left out is Fresnel's factor and the shadowing of ω, which vary little over a lobe; and the sides, which
/// are not quite great circles of ω.
template <class Real>
class VisibleNormalPolygon {
 public:
  VisibleNormalPolygon(const NormalFrame<Real>& frame, const Direction<Real>& view, Real roughness)
      : frame_(frame),
        view_(view),
        per_roughness_(Real(1) / roughness),
        stretched_view_(stretch(frame.into(view), roughness)) {}

  /// Vertices in turn, counterclockwise about the normal; the first one once more to close.
  void add(const Direction<Real>& direction) {
    const Direction<Real> half = {view_.x + direction.x, view_.y + direction.y, view_.z + direction.z};
    const Direction<Real> vertex = stretch(frame_.into(half), per_roughness_);
    if (has_vertex_) sum_ = sum_ + side(before_, vertex);
    before_ = vertex;
    has_vertex_ = true;
  }

  /// ∫ N·v′ dN over it, but for a factor of 2.
  Real value() const { return sum_; }

 private:
  static Direction<Real> stretch(const Direction<Real>& d, Real factor) {
    using std::sqrt;
    const Real x = d.x * factor;
    const Real y = d.y * factor;
    const Real scale = Real(1) / sqrt(x * x + y * y + d.z * d.z);
    return {x * scale, y * scale, d.z * scale};
  }

  Real side(const Direction<Real>& from, const Direction<Real>& to) const {
    using std::sqrt;
    const Direction<Real> plane = cross(from, to);
    const Real sine_squared = dot(plane, plane);
    const Real cosine = dot(from, to);
    const Real least = static_cast<Real>(1e-12);  // from here on the angle is its sine
    const Real angle_over_sine =
        sine_squared < least ? Real(1) : angle_of_cosine(cosine) / sqrt(sine_squared);
    return angle_over_sine * dot(plane, stretched_view_);
  }

  NormalFrame<Real> frame_;
  Direction<Real> view_;
  Real per_roughness_;
  Direction<Real> stretched_view_;
  Direction<Real> before_;
  bool has_vertex_ = false;
  Real sum_{0};
};

/// Horizons of a place as a horizon map stores them: toward the azimuths 2π k/count from x to y, as slopes
/// (the tangent of the elevation above the map's plane, at least that of the tangent plane).
///
/// Between two of them, a sector σ apart, the horizon is taken to be the great circle through both, whose
/// slope
///     m(φ) = (m_a sin(σ − φ) + m_b sin φ)/sin σ
/// is exact for a straight edge, however it runs, and for the tangent plane.
template <class Real>
class StoredHorizons {
 public:
  StoredHorizons(const Real* slopes, std::size_t count) : slopes_(slopes), count_(count) {}

  std::size_t count() const { return count_; }

  /// How much a direction is above the horizon, not below 0 where it is: its z less that of the horizon at
  /// its azimuth, times the sine of a sector.
  Real above(const Direction<Real>& d) const {
    using std::atan2;
    using std::sin;
    using std::sqrt;
    const double sector = 2 * kPiOfForms / static_cast<double>(count_);
    const Real angle = atan2(d.y, d.x);
    const Real azimuth = angle < Real(0) ? angle + Real(2 * kPiOfForms) : angle;
    const std::size_t k = static_cast<std::size_t>(static_cast<double>(azimuth) / sector) % count_;
    const Real within = azimuth - Real(sector * static_cast<double>(k));
    const Real rise = slopes_[k] * sin(Real(sector) - within) + slopes_[(k + 1) % count_] * sin(within);
    return d.z * Real(std::sin(sector)) - rise * sqrt(d.x * d.x + d.y * d.y);
  }

  /// Slope at a share of the way from azimuth k to the next one.
  Real slope(std::size_t k, double share) const {
    const double sector = 2 * kPiOfForms / static_cast<double>(count_);
    const double scale = 1 / std::sin(sector);
    return Real(std::sin(sector * (1 - share)) * scale) * slopes_[k % count_] +
           Real(std::sin(sector * share) * scale) * slopes_[(k + 1) % count_];
  }

  /// Unit vector toward azimuth k, which need not be whole.
  Direction<Real> azimuth(double k) const {
    const double angle = 2 * kPiOfForms * k / static_cast<double>(count_);
    return {Real(std::cos(angle)), Real(std::sin(angle)), Real(0)};
  }

 private:
  const Real* slopes_;
  std::size_t count_;
};

/// Directions of the lobe by which horizon_occlusion looks.
inline constexpr int kHorizonSamples = 16;

/// What a lobe sees of the sky, straight from stored horizons: `samples` of GGX's visible normals, the same
/// for every place, mirror the view into directions that are above the horizon or not; those above the
/// tangent plane count by Fresnel's factor, of a reflectance of 0.04, and the light's shadowing. 1 in the
/// open. normal and view in the map's axes, z up, n·v > 0.
template <class Real>
Real horizon_occlusion(const Direction<Real>& normal, const Direction<Real>& view, Real roughness,
                       const StoredHorizons<Real>& horizons, int samples = kHorizonSamples) {
  const NormalFrame<Real> frame(normal);
  const Direction<Real> own_view = frame.into(view);
  Real whole(0);
  Real open(0);
  for (int i = 0; i < samples; ++i) {
    const double turns = 0.25 + i * 0.61803398874989485;  // a Fibonacci lattice
    const GgxDirection<Real> light = mirror_visible_normal(own_view, roughness, Real((i + 0.5) / samples),
                                                           Real(turns - std::floor(turns)));
    if (!(Real(0) < light.direction.z)) continue;
    const Real weight =
        schlick(Real(0.04), light.facet_cosine) * smith_shadowing(roughness, light.direction.z);
    whole = whole + weight;
    if (!(horizons.above(frame.out_of(light.direction)) < Real(0))) open = open + weight;
  }
  return Real(0) < whole ? open / whole : Real(1);
}

/// Sides of the polygon to each stored horizon.
inline constexpr int kSidesOfSector = 4;

/// The same in closed form: of the lobe's visible normals, those that mirror the view above the polygon of
/// horizons, over those above the tangent plane's. Fresnel's factor and the light's shadowing are left out.
template <class Real>
Real horizon_polygon_occlusion(const Direction<Real>& normal, const Direction<Real>& view, Real roughness,
                               const StoredHorizons<Real>& horizons) {
  using std::sqrt;
  const NormalFrame<Real> frame(normal);
  VisibleNormalPolygon<Real> seen(frame, view, roughness);
  VisibleNormalPolygon<Real> open(frame, view, roughness);
  const auto with_slope = [](const Direction<Real>& azimuth, const Real& slope) {
    const Real scale = Real(1) / sqrt(Real(1) + slope * slope);
    return Direction<Real>{azimuth.x * scale, azimuth.y * scale, slope * scale};
  };
  const int sides = static_cast<int>(horizons.count()) * kSidesOfSector;
  for (int i = 0; i <= sides; ++i) {
    const int vertex = i % sides;
    const auto k = static_cast<std::size_t>(vertex / kSidesOfSector);
    const double share = static_cast<double>(vertex % kSidesOfSector) / kSidesOfSector;
    const Direction<Real> azimuth = horizons.azimuth(static_cast<double>(k) + share);
    seen.add(with_slope(azimuth, horizons.slope(k, share)));
    open.add(with_slope(azimuth, (Real(0) - normal.x * azimuth.x - normal.y * azimuth.y) / normal.z));
  }
  return clamp_share(seen.value() / open.value());
}

/// $slopes stands for the horizons as arguments, four to a vector, $given for the same as they are passed on.
inline constexpr const char* kHorizonShader =
    R"(float heightlight_horizon_occlusion(vec3 normal, vec3 view, float roughness, $slopes) {
  vec3 tangent = heightlight_tangent(normal);
  vec3 bitangent = heightlight_bitangent(normal);
  vec3 seen_from = vec3(dot(view, tangent), dot(view, bitangent), dot(view, normal));
  float whole = 0.0;
  float open = 0.0;
  for (int i = 0; i < $samples; i++) {
    float turn = fract(0.25 + 0.618033989 * float(i));
    vec4 light = heightlight_lobe_direction(seen_from, roughness, (float(i) + 0.5) / $samples.0, turn);
    if (light.z > 0.0) {
      float weight = heightlight_lobe_weight(roughness, light.z, light.w);
      vec3 d = light.x * tangent + light.y * bitangent + light.z * normal;
      whole += weight;
      if (heightlight_horizon_above(d, $given) >= 0.0) { open += weight; }
    }
  }
  if (whole > open) { return open / whole; }
  return 1.0;
}
)";

}  // namespace heightlight
