#include "bake/bent_cone.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/texel_algebra.h"
#include "heightlight/occlusion_forms.h"

namespace heightlight {
double cone_of_openness(double sky_view_factor) {
  return angle_of_cosine(cone_cosine(SkyViewFactor{sky_view_factor}));
}

// With p = 3/2 R − 1, R = 2/3 (1 + u + u²)/(1 + u) is u² − p u − p = 0.
double cone_of_spread(double sky_view_factor, const Vector3& first) {
  if (!(sky_view_factor > 0)) return 0;
  const double p = std::clamp(1.5 * as_eigen(first).cast<double>().norm() / sky_view_factor - 1, 0.0, 0.5);
  if (p < 1e-6) return std::numbers::pi / 2;  // what rounding leaves of 0 has a root of 10⁻³
  return angle_of_cosine(0.5 * (p + std::sqrt(p * p + 4 * p)));
}

}  // namespace heightlight
