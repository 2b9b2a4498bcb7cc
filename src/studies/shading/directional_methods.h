#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "heightlight/occlusion_forms.h"
#include "visibility/triple_product.h"

// Diffuse light of a sky from an ambient occlusion, as shaders find it: E/π, from nine harmonics of the sky.
// Templates, so that their operations can be counted.

namespace heightlight {

/// What a shader knows of a texel.
template <class Real>
struct DiffuseTexel {
  Direction<Real> normal, bent_normal;
  SkyViewFactor<Real> sky{Real(1)};
};

/// A times what an open plane gets that faces along the normal.
template <class Real>
Real shade_by_normal(const NineHarmonics<Real>& sky, const DiffuseTexel<Real>& texel) {
  return clamp_share(texel.sky.value) *
         directional_irradiance(sky, SkyViewFactor<Real>(Real(1)), texel.normal);
}

/// The same along the bent normal (Landis 2002).
template <class Real>
Real shade_by_bent_normal(const NineHarmonics<Real>& sky, const DiffuseTexel<Real>& texel) {
  return clamp_share(texel.sky.value) *
         directional_irradiance(sky, SkyViewFactor<Real>(Real(1)), texel.bent_normal);
}

/// Cone, cosine to the normal, and sky, each in nine harmonics (Snyder 2006).
template <class Real>
Real shade_by_triple_product(const NineHarmonics<Real>& sky, const DiffuseTexel<Real>& texel) {
  return triple_product(sky, turn_zonal(cap_zonal_harmonics(cone_cosine(texel.sky)), texel.bent_normal),
                        cone_harmonics(SkyViewFactor<Real>(Real(1)), texel.normal));
}

/// Directional GTAO.
template <class Real>
Real shade_by_cone(const NineHarmonics<Real>& sky, const DiffuseTexel<Real>& texel) {
  return directional_irradiance(sky, texel.sky, texel.bent_normal);
}

/// The same of a cone that was found otherwise.
template <class Real>
Real shade_by_given_cone(const NineHarmonics<Real>& sky, const DiffuseTexel<Real>& texel, Real cosine) {
  return directional_irradiance(sky, SkyViewFactor<Real>(Real(1) - cosine * cosine), texel.bent_normal);
}

/// Names of ways to shade.
inline constexpr const char* kAoProbe = "AO, probe";
inline constexpr const char* kBentProbe = "bent normal, probe";
inline constexpr const char* kAoHarmonics = "AO, SH9";
inline constexpr const char* kBentHarmonics = "bent normal, SH9";
inline constexpr const char* kTripleProduct = "triple product, SH9";
inline constexpr const char* kDirectionalGtao = "directional GTAO, SH9";
inline constexpr const char* kSpreadCone = "cone of the spread, SH9";
inline constexpr const char* kOwnHarmonics = "sh map, SH9";

/// What a cone and its cosine make in nine harmonics, for a cone about the bent normal whose normal is turned
/// away from it (figure 10 of Jimenez 2016). Relative to the norm of the true coefficients, those of the cone
/// with the cosine to the normal, clamped.
struct ConeFormError {
  double half_angle = 0;  ///< α_v, rad
  double turn = 0;        ///< θ_v between bent normal and normal, rad
  double by_cone = 0;     ///< directional GTAO: the cosine to the bent normal
  double by_product = 0;  ///< the product of both in nine harmonics
};

/// Over `steps` × `steps` cones and turns, up to π/2.
std::vector<ConeFormError> judge_cone_forms(int steps);

}  // namespace heightlight
