#pragma once

#include <array>
#include <cmath>

#include "heightlight/forms.h"
#include "heightlight/image.h"

// A cone of visibility about the bent normal, as Jimenez et al. 2016, section 5, light it: what of a sky's
// spherical harmonics reaches a texel that is known by its sky view factor A and its bent normal alone.

namespace heightlight {

/// What the cone passes of each band l = 0, 1, 2 of the sky's harmonics, so that
///     E/π = Σ_l passes_l Σ_m L_lm Y_lm(bent normal):
/// the sums over m are the sky's own bands as seen toward the bent normal, whatever basis they are stored in.
template <class Real>
struct ConeBands {
  Real constant;
  Real linear;
  Real quadratic;
};

/// Of the cone that is as open as A, cos²β = 1 − A (eq. 22), its cosine taken about its axis. With c = cos β,
/// the zonal harmonics of eq. 23 turned by eq. 17, √(4π/(2l + 1)) z_l/π, are
///     A,  2/3 (1 − c³),  A (1 + 3 c²)/4,
/// where 1 − c³ = A (1 + c + c²)/(1 + c) loses no digits as A goes to 0. Of an open place: 1, 2/3, 1/4.
template <class Real>
ConeBands<Real> cone_bands(SkyViewFactor<Real> sky) {
  const Real a = clamp_share(sky.value);
  const Real squared = 1 - a;
  const Real c = std::sqrt(squared);
  return {a, Real(2) / Real(3) * (a * ((1 + c + squared) / (1 + c))), Real(0.25) * (a * (1 + 3 * squared))};
}

inline constexpr const char* kConeBandsShader = R"(vec3 heightlight_cone_bands(float sky) {
  float a = heightlight_share(sky);
  float squared = 1.0 - a;
  float c = sqrt(squared);
  return vec3(a, 0.666666667 * (a * ((1.0 + c + squared) / (1.0 + c))), 0.25 * (a * (1.0 + 3.0 * squared)));
}
)";

/// The same as coefficients over the nine real spherical harmonics, in the order Y00, Y1−1, Y10, Y11, Y2−2,
/// Y2−1, Y20, Y21, Y22 (orthonormal, without the Condon–Shortley phase, z the pole), as `bake --maps sh` has
/// them: E/π under a sky is their dot product with the sky's. `axis`: the bent normal, a unit vector.
std::array<double, 9> cone_harmonics(SkyViewFactor<double> sky, const Vector3& axis);

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

}  // namespace heightlight
