#include "heightlight/visibility_cone.h"

#include "base/texel_algebra.h"
#include "visibility/sky_harmonics.h"

namespace heightlight {

std::array<double, 9> cone_harmonics(SkyViewFactor<double> sky, const Vector3& axis) {
  const ConeBands<double> bands = cone_bands(sky);
  Harmonics coefficients = harmonics_of(as_eigen(axis).cast<double>());
  for (std::size_t i = 0; i < coefficients.size(); ++i)
    coefficients[i] *= i == 0 ? bands.constant : i < 4 ? bands.linear : bands.quadratic;
  return coefficients;
}

}  // namespace heightlight
