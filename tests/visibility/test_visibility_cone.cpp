#include <Eigen/Geometry>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "base/gauss_legendre.h"
#include "heightlight/occlusion_forms.h"
#include "visibility/sky_harmonics.h"

namespace heightlight {
namespace {

/// (1/π) ∫ Y_lm(ω) cosθ dω over a cone about `axis`, by quadrature.
Harmonics integrate_cone(double half_angle, const Eigen::Vector3d& axis) {
  const Eigen::Vector3d side = axis.unitOrthogonal();
  const Eigen::Vector3d other = axis.cross(side);
  constexpr int kAzimuths = 16;
  Harmonics sum{};
  for (const QuadratureNode& node : gauss_legendre(16)) {
    const double low = std::cos(half_angle);
    const double cosine = low + node.at * (1 - low);
    const double sine = std::sqrt(1 - cosine * cosine);
    for (int k = 0; k < kAzimuths; ++k) {
      const double azimuth = 2 * std::numbers::pi * k / kAzimuths;
      const Harmonics y =
          harmonics_of(cosine * axis + sine * (std::cos(azimuth) * side + std::sin(azimuth) * other));
      for (std::size_t i = 0; i < y.size(); ++i)
        sum[i] += node.weight * (1 - low) * 2 / kAzimuths * cosine * y[i];
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("a cone's harmonics are its integrals", "[visibility]") {
  for (const double sky : {0.0, 0.1, 0.5, 0.9, 1.0}) {
    const Direction<double> axis{0.48, -0.6, 0.64};
    const NineHarmonics<double> found = cone_harmonics(SkyViewFactor(sky), axis);
    const Harmonics expected = integrate_cone(std::acos(std::sqrt(1 - sky)), {0.48, -0.6, 0.64});
    for (std::size_t i = 0; i < found.size(); ++i) {
      CAPTURE(sky, i);
      CHECK(found[i] == Approx(expected[i]).margin(1e-14));
    }
  }
}

TEST_CASE("of a uniform sky a cone passes A, of an open place what a cosine does", "[visibility]") {
  const std::array<double, 3> open = cone_bands(SkyViewFactor(1.0));
  CHECK(open[0] == 1);
  CHECK(open[1] == Approx(2.0 / 3).epsilon(1e-15));
  CHECK(open[2] == 0.25);
  for (const double sky : {-0.1, 0.0, 1e-9, 0.3}) {
    const std::array<double, 3> bands = cone_bands(SkyViewFactor(sky));
    CHECK(bands[0] == std::max(sky, 0.0));
    CHECK(bands[1] == Approx(std::max(sky, 0.0)).epsilon(0.2));  // to first order; a ray passes all alike
    CHECK(bands[2] <= bands[1]);
  }
}

}  // namespace heightlight
