#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "heightlight/forms.h"

// Closed forms that shade with an ambient occlusion which knows a direction: diffuse light of a sky that is
// not the same all over, and what a glossy lobe sees. Like forms.h this file needs C++17 and the standard
// library's mathematics and nothing else, so that an engine may take both alone. Pure functions, of float or
// double. Each form is stated here and nowhere else, beside its text as a shader function, which serves GLSL
// and HLSL: $2, $3 and $4 stand for the types of as many floats, $name for a constant.
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

/// z_l, l ≤ 2, of a cone whose directions count by the cosine to its axis: ∫ Y_l0 cosθ dω over it (Jimenez
/// 2016, eq. 23), of the cosine of its half-angle in [0, 1].
template <class Real>
std::array<Real, 3> cone_zonal_harmonics(Real cosine) {
  const Real squared = cosine * cosine;
  const Real sine_squared = Real(1) - squared;
  return {Real(0.88622692545275801) * sine_squared,                                   // √π/2
          Real(1.0233267079464885) * (Real(1) - cosine * squared),                    // √(3π)/3
          Real(0.24770795610037571) * sine_squared * (Real(2) + Real(6) * squared)};  // √(5π)/16
}

/// The same of a cone whose directions all count the same: ∫ Y_l0 dω.
template <class Real>
std::array<Real, 3> cap_zonal_harmonics(Real cosine) {
  const Real sine_squared = Real(1) - cosine * cosine;
  return {Real(1.7724538509055161) * (Real(1) - cosine),      // √π
          Real(1.5349900619197328) * sine_squared,            // √(3π)/2
          Real(1.9816636488030057) * cosine * sine_squared};  // √(5π)/2
}

/// Coefficients of what is symmetric about an axis: √(4π/(2l + 1)) z_l Y_lm(axis) (Jimenez 2016, eq. 17).
template <class Real>
NineHarmonics<Real> turn_zonal(const std::array<Real, 3>& zonal, const Direction<Real>& axis) {
  const Real scale[] = {Real(3.5449077018110318) * zonal[0], Real(2.0466534158929770) * zonal[1],
                        Real(1.5853309190424043) * zonal[2]};  // √(4π), √(4π/3), √(4π/5)
  NineHarmonics<Real> turned = harmonics_along(axis);
  for (std::size_t i = 0; i < turned.size(); ++i) turned[i] = scale[i == 0 ? 0 : i < 4 ? 1 : 2] * turned[i];
  return turned;
}

/// E/π under a sky of nine coefficients, from a bent normal and its A: the cone that is as open, cosine
/// weighted about the bent normal (directional GTAO, Jimenez 2016, eqs. 16, 17, 22 and 23). With the normal
/// and A = 1 it is what an open plane receives. Harmonics ring: it may be a little below 0.
template <class Real>
Real directional_irradiance(const NineHarmonics<Real>& sky_light, SkyViewFactor<Real> sky,
                            const Direction<Real>& bent_normal) {
  return Real(1 / kPiOfForms) *
         dot(sky_light, turn_zonal(cone_zonal_harmonics(cone_cosine(sky)), bent_normal));
}

inline constexpr FormText kDirectionalText{
    "directional_gtao", "sum over l, m of L_lm sqrt(4 pi/(2 l + 1)) z_l(A) Y_lm(b) / pi",
    "Jimenez 2016 eqs. 16, 17, 22, 23",
    R"(// Irradiance E/pi under a sky of nine harmonics, from a bent normal (unit) and its A: the cone that is as open,
// cosine weighted about the bent normal (Jimenez 2016, eqs. 16, 17, 22 and 23). sky_light: coefficients of red,
// green and blue in the order Y00, Y1-1, Y10, Y11, Y2-2, Y2-1, Y20, Y21, Y22, in the axes of the bent normal.
$3 heightlight_directional_irradiance($3 sky_light[9], float sky, $3 bent) {
  float c2 = 1.0 - heightlight_share(sky);
  float s2 = 1.0 - c2;
  float z1 = 0.325735008 * (1.0 - sqrt(c2) * c2);
  float z2 = 0.136568554 * s2 * (2.0 + 6.0 * c2);
  return 0.282094792 * s2 * sky_light[0] +
         z1 * (bent.y * sky_light[1] + bent.z * sky_light[2] + bent.x * sky_light[3]) +
         z2 * (bent.x * bent.y * sky_light[4] + bent.y * bent.z * sky_light[5] + bent.x * bent.z * sky_light[7] +
               0.5 * (bent.x * bent.x - bent.y * bent.y) * sky_light[8] +
               0.288675135 * (3.0 * bent.z * bent.z - 1.0) * sky_light[6]);
}
)"};

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
/// π]. By Gauss and Bonnet: where the circles cross, with ψ the angle between their radii there and φ_a, φ_b
/// half of the turn about each axis that the lens takes,
///     2π − 2ψ − 2 φ_a cos a − 2 φ_b cos b
/// (Oat and Sander 2007; Mazonka 2012). Errs by some 10⁻⁸ near where the circles touch.
template <class Real>
Real shared_solid_angle(Real a, Real b, Real d) {
  using std::cos;
  using std::sin;
  const Real smaller = a < b ? a : b;
  if (smaller == Real(0) || a + b < d) return Real(0);
  if (d < a + b - Real(2) * smaller) return cap_solid_angle(smaller);
  const Real cos_a = cos(a), cos_b = cos(b), cos_d = cos(d);
  const Real sin_a = sin(a), sin_b = sin(b), sin_d = sin(d);
  const Real between = angle_of_cosine((cos_d - cos_a * cos_b) / (sin_a * sin_b));
  const Real turn_a = angle_of_cosine((cos_b - cos_a * cos_d) / (sin_a * sin_d));
  const Real turn_b = angle_of_cosine((cos_a - cos_b * cos_d) / (sin_b * sin_d));
  const Real shared = Real(2) * (Real(kPiOfForms) - between - turn_a * cos_a - turn_b * cos_b);
  return shared < Real(0) ? Real(0) : shared;
}

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

inline constexpr FormText kConeConeText{
    "cone_cone", "shared solid angle of the cones over the lobe's", "Jimenez 2016 eqs. 34, 35",
    R"(float heightlight_angle(float cosine) { return acos(min(max(cosine, -1.0), 1.0)); }

// What a glossy lobe sees of the sky: the share of the lobe's cone about the mirrored view that the cone of
// openness about the bent normal covers (Jimenez 2016, eqs. 34 and 35). apart: angle between the two axes.
// roughness: alpha of GGX.
float heightlight_cone_cone(float sky, float apart, float roughness) {
  float a = heightlight_angle(sqrt(1.0 - heightlight_share(sky)));
  float b = heightlight_angle(pow($share, 0.5 * roughness * roughness));
  float half_sine = sin(0.5 * b);
  float lobe = 12.5663706 * half_sine * half_sine;
  if (apart >= a + b) return 0.0;
  if (apart <= b - a) return (1.0 - cos(a)) * 6.28318531 / lobe;
  if (apart <= a - b) return 1.0;
  float lens = 6.28318531 - 2.0 * heightlight_angle((cos(apart) - cos(a) * cos(b)) / (sin(a) * sin(b))) -
                 2.0 * cos(a) * heightlight_angle((cos(b) - cos(a) * cos(apart)) / (sin(a) * sin(apart))) -
                 2.0 * cos(b) * heightlight_angle((cos(a) - cos(b) * cos(apart)) / (sin(b) * sin(apart)));
  return heightlight_share(lens / lobe);
}
)"};

/// Where the table of GTSO (SpecularTable in gloss.h, the file of specular-table) is to be read. It is a 3D
/// texture of $side × $side × $side² texels, whose layers run over the roughness first, then over the view's
/// angle: linear filtering of two places, mixed.
inline constexpr FormText kTableText{
    "gtso", "table of eq. 30 by cone, angle, roughness and view", "Jimenez 2016 eq. 30",
    R"(float heightlight_falloff(float widths) { return widths / sqrt(1.0 + widths * widths); }

// What a glossy lobe sees of the sky, by the table gtso.ktx of $side^4 values (Jimenez 2016, eq. 30). With
//     $4 p = heightlight_table_place(sky, apart, roughness, view_cosine);
// it is mix(a, b, heightlight_table_weight(view_cosine)) of the table, filtered linearly, at a: p.xyz, b: p.xyw.
// apart: angle between bent normal and mirrored view; view_cosine: n.v; roughness: alpha of GGX.
$4 heightlight_table_place(float sky, float apart, float roughness, float view_cosine) {
  float cone = acos(sqrt(1.0 - heightlight_share(sky)));
  float width = 2.0 * max(roughness, 1e-4);
  float begin = heightlight_falloff(-cone / width);
  float span = heightlight_falloff((3.14159265 - cone) / width) - begin;
  float y = (heightlight_falloff((apart - cone) / width) - begin) / span;
  float view = acos(heightlight_share(view_cosine)) / 1.57079633 * ($side.0 - 1.0);
  float layer = min(floor(view), $side.0 - 2.0) * $side.0 + sqrt(heightlight_share(roughness)) * ($side.0 - 1.0);
  float x = cone / 1.57079633;
  return $4((x * ($side.0 - 1.0) + 0.5) / $side.0, (y * ($side.0 - 1.0) + 0.5) / $side.0,
              (layer + 0.5) / ($side.0 * $side.0), (layer + $side.0 + 0.5) / ($side.0 * $side.0));
}

float heightlight_table_weight(float view_cosine) {
  float view = acos(heightlight_share(view_cosine)) / 1.57079633 * ($side.0 - 1.0);
  return view - min(floor(view), $side.0 - 2.0);
}
)"};

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

inline constexpr FormText kLagardeText{
    "lagarde", "(n.v + A)^(2^(-16 r - 1)) - 1 + A, in [0, 1]", "Lagarde and de Rousiers 2014",
    R"(// Lagarde and de Rousiers 2014. view_cosine: n.v; roughness: alpha of GGX.
float heightlight_lagarde(float sky, float view_cosine, float roughness) {
  float a = heightlight_share(sky);
  return heightlight_share(pow(view_cosine + a, exp2(-16.0 * roughness - 1.0)) - 1.0 + a);
}
)"};

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

inline constexpr FormText kHorizonText{
    "horizons", "share of the lobe's directions that are above stored horizons",
    "here; visible normals: Heitz 2018",
    R"(// What a glossy lobe sees of the sky, straight from the horizon map. slope: tangents of the horizon's elevation
// above the map's plane, at least those of the tangent plane, toward the azimuths 2 pi k/$count from x to y; between
// two of them the horizon is the great circle through both. normal and view (from the surface) unit, in the
// same axes, z up; roughness: alpha of GGX. The $samples directions are GGX's visible normals (Heitz 2018), mirrored.
float heightlight_horizon_occlusion($3 normal, $3 view, float roughness, float slope[$count]) {
  float a = -1.0 / (1.0 + normal.z);
  float b = normal.x * normal.y * a;
  $3 tangent = $3(1.0 + normal.x * normal.x * a, b, -normal.x);
  $3 bitangent = $3(b, 1.0 + normal.y * normal.y * a, -normal.y);
  $3 v = $3(dot(view, tangent), dot(view, bitangent), dot(view, normal));
  $3 seen = normalize($3(roughness * v.x, roughness * v.y, v.z));
  float flat_length = sqrt(seen.x * seen.x + seen.y * seen.y);
  $3 across = flat_length > 0.0 ? $3(-seen.y, seen.x, 0.0) / flat_length : $3(1.0, 0.0, 0.0);
  $3 along = cross(seen, across);
  float share = 0.5 + 0.5 * seen.z;
  float whole = 0.0;
  float open = 0.0;
  for (int i = 0; i < $samples; i++) {
    float radius = sqrt((float(i) + 0.5) / $samples.0);
    float turn = 6.28318531 * (0.25 + 0.618033989 * float(i));
    float x = radius * cos(turn);
    float y = (1.0 - share) * sqrt(max(1.0 - x * x, 0.0)) + share * radius * sin(turn);
    $3 n = x * across + y * along + sqrt(max(1.0 - x * x - y * y, 0.0)) * seen;
    $3 facet = normalize($3(roughness * n.x, roughness * n.y, max(n.z, 1e-6)));
    float cosine = dot(v, facet);
    $3 light = 2.0 * cosine * facet - v;
    if (light.z <= 0.0) continue;
    float rest = 1.0 - min(cosine, 1.0);
    float weight = (0.04 + 0.96 * rest * rest * rest * rest * rest) * 2.0 /
                   (1.0 + sqrt(1.0 + roughness * roughness * (1.0 / (light.z * light.z) - 1.0)));
    whole += weight;
    $3 d = light.x * tangent + light.y * bitangent + light.z * normal;
    float sector = 6.28318531 / $count.0;
    float azimuth = $atan2(d.y, d.x);
    azimuth = azimuth < 0.0 ? azimuth + 6.28318531 : azimuth;
    int k = min(int(azimuth / sector), $count - 1);
    float within = azimuth - sector * float(k);
    float rise = slope[k] * sin(sector - within) + slope[k == $count - 1 ? 0 : k + 1] * sin(within);
    if (d.z * sin(sector) >= rise * sqrt(d.x * d.x + d.y * d.y)) open += weight;
  }
  return whole > 0.0 ? open / whole : 1.0;
}
)"};

}  // namespace heightlight
