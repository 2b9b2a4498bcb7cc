#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/gauss_legendre.h"
#include "gloss/ggx_lobe.h"
#include "heightlight/occlusion_forms.h"

// Closed forms against numerical integration.

namespace heightlight {
namespace {

using std::numbers::pi;
using Unit = Direction<double>;

Unit unit(double x, double y, double z) {
  const double length = std::sqrt(x * x + y * y + z * z);
  return {x / length, y / length, z / length};
}

/// ∫ f(ω) dω over the cone about an axis, f of the direction and the cosine to the axis: Gauss's rule in the
/// cosine, equal steps around.
template <class Function>
double integrate_cone(const Unit& axis, double half_angle, Function&& f) {
  static const std::vector<QuadratureNode> kNodes = gauss_legendre(24);
  constexpr int kSteps = 32;
  const NormalFrame<double> frame(axis);
  double sum = 0;
  for (const QuadratureNode& node : kNodes) {
    const double cosine = 1 - node.at * (1 - std::cos(half_angle));
    const double sine = std::sqrt(1 - cosine * cosine);
    for (int k = 0; k < kSteps; ++k) {
      const double c = sine * std::cos(2 * pi * k / kSteps);
      const double s = sine * std::sin(2 * pi * k / kSteps);
      const Unit d{c * frame.tangent.x + s * frame.bitangent.x + cosine * axis.x,
                   c * frame.tangent.y + s * frame.bitangent.y + cosine * axis.y,
                   c * frame.tangent.z + s * frame.bitangent.z + cosine * axis.z};
      sum += node.weight * (1 - std::cos(half_angle)) * 2 * pi / kSteps * f(d, cosine);
    }
  }
  return sum;
}

const std::vector<double> kHalfAngles{0.05, 0.3, 0.7, 1.1, 1.4, pi / 2};

}  // namespace

TEST_CASE("harmonics of cones agree with their integrals", "[gloss]") {
  const Unit axis = unit(0.4, -0.3, 0.8);
  for (const double angle : kHalfAngles) {
    const NineHarmonics<double> weighted = cone_harmonics(SkyViewFactor(std::pow(std::sin(angle), 2)), axis);
    const NineHarmonics<double> plain = turn_zonal(cap_zonal_harmonics(std::cos(angle)), axis);
    for (std::size_t i = 0; i < 9; ++i) {
      INFO(angle << " coefficient " << i);
      CHECK(weighted[i] == Approx(integrate_cone(axis, angle, [&](const Unit& d, double cosine) {
                             return harmonics_along(d)[i] * cosine / pi;
                           })).margin(1e-12));  // identity: the rules are exact for these polynomials
      CHECK(plain[i] == Approx(integrate_cone(axis, angle, [&](const Unit& d, double) {
                          return harmonics_along(d)[i];
                        })).margin(1e-12));
    }
  }
}

TEST_CASE("nine harmonics are orthonormal", "[gloss]") {
  for (std::size_t i = 0; i < 9; ++i) {
    for (std::size_t j = 0; j < 9; ++j) {
      const double product = integrate_cone({0, 0, 1}, pi, [&](const Unit& d, double) {
        return harmonics_along(d)[i] * harmonics_along(d)[j];
      });
      CHECK(product == Approx(i == j ? 1 : 0).margin(1e-12));  // identity
    }
  }
}

TEST_CASE("directional irradiance is the cone's integral over the sky", "[gloss]") {
  const NineHarmonics<double> sky{0.9, 0.2, 0.4, -0.3, 0.1, 0.25, -0.15, 0.05, 0.3};
  const Unit bent = unit(-0.2, 0.5, 0.7);
  for (const double open : {0.02, 0.3, 0.7, 1.0}) {
    const double angle = std::acos(std::sqrt(1 - open));
    const double expected =
        integrate_cone(bent, angle,
                       [&](const Unit& d, double cosine) { return dot(sky, harmonics_along(d)) * cosine; }) /
        pi;
    CHECK(directional_irradiance(sky, SkyViewFactor{open}, bent) ==
          Approx(expected).margin(1e-12));  // identity
  }
  const NineHarmonics<double> even{std::sqrt(4 * pi)};
  CHECK(directional_irradiance(even, SkyViewFactor{0.37}, bent) == Approx(0.37));  // A, under an even sky
}

TEST_CASE("the shared solid angle of cones agrees with its integral", "[gloss]") {
  const auto integrate = [](double a, double b, double d) {
    // Over circles about the first axis, each of which lies in the other cone by part; t³ takes the roots out
    // of both ends of the crossing.
    constexpr int kSteps = 20000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double theta = a * (i + 0.5) / kSteps;
      const double cosine = (std::cos(b) - std::cos(theta) * std::cos(d)) / (std::sin(theta) * std::sin(d));
      const double inside = cosine >= 1 ? 0 : cosine <= -1 ? 2 * pi : 2 * std::acos(cosine);
      sum += inside * (std::cos(a * i / kSteps) - std::cos(a * (i + 1.0) / kSteps));
    }
    return sum;
  };
  for (const double a : kHalfAngles) {
    for (const double b : kHalfAngles) {
      for (const double d : {0.01, 0.2, 0.6, 1.0, 1.5, 2.0, 3.0}) {
        INFO(a << " " << b << " " << d);
        const double shared = shared_solid_angle(a, b, d);
        CHECK(shared == Approx(integrate(a, b, d)).margin(1e-6));  // discretisation: steps of 8e-5
        CHECK(shared == Approx(shared_solid_angle(b, a, d)).margin(1e-12));
      }
    }
  }
  CHECK(shared_solid_angle(0.3, 1.0, 0.0) == Approx(cap_solid_angle(0.3)));
  CHECK(shared_solid_angle(0.0, 1.0, 1.0) == 0);
  CHECK(cap_solid_angle(pi / 2) == Approx(2 * pi));
}

TEST_CASE("forms of specular occlusion keep their limits", "[gloss]") {
  const SkyViewFactor<double> open{1};
  for (const double roughness : {0.01, 0.1, 0.5, 1.0}) {
    for (const double apart : {0.0, 0.4, 1.0}) {
      if (apart + lobe_cone(roughness) < pi / 2)
        CHECK(cone_cone_occlusion(open, apart, roughness) == Approx(1));
      CHECK(cone_cone_occlusion(SkyViewFactor{0.0}, apart, roughness) == Approx(0).margin(1e-12));
      CHECK(cone_cone_occlusion(SkyViewFactor{0.4}, apart, roughness) >= 0);
    }
    for (const double view : {0.1, 0.7, 1.0}) {
      CHECK(lagarde_occlusion(open, view, roughness) == 1);
      CHECK(lagarde_occlusion(SkyViewFactor{0.0}, view, roughness) <= 1);
    }
  }
  // Where the lobe is a ray, Lagarde's form lies above A: (n.v + A)^0.5 − 1 + A.
  CHECK(lagarde_occlusion(SkyViewFactor{0.5}, 1.0, 1e-9) == Approx(std::sqrt(1.5) - 0.5));
  CHECK(lobe_cone(0.02) == Approx(std::acos(std::pow(0.01, 2e-4))));
}

TEST_CASE("horizons say that an open plane is open, however tilted", "[gloss]") {
  for (const Unit normal : {unit(0, 0, 1), unit(0.5, 0.2, 0.6), unit(-0.9, 0.3, 0.2)}) {
    std::vector<double> tangent;
    for (int k = 0; k < 8; ++k) {
      const double azimuth = 2 * pi * k / 8;
      tangent.push_back(-(normal.x * std::cos(azimuth) + normal.y * std::sin(azimuth)) / normal.z);
    }
    const StoredHorizons<double> horizons(tangent.data(), tangent.size());
    for (const double roughness : {0.02, 0.13, 0.4, 1.0}) {
      for (const Unit view : {unit(0, 0, 1), unit(0.3, -0.5, 0.4), unit(0.1, 0.9, 0.5)}) {
        if (dot(view, normal) <= 0) continue;
        // Identities, but for directions along the plane itself, which hardly count.
        CHECK(horizon_occlusion(normal, view, roughness, horizons) == Approx(1));
        CHECK(horizon_polygon_occlusion(normal, view, roughness, horizons) == Approx(1));
      }
    }
  }
}

TEST_CASE("horizons are great circles between those that are stored", "[gloss]") {
  // A straight edge: the plane through the place and the edge has normal m.
  const Unit m = unit(-0.3, 0.2, 0.8);
  std::vector<double> slopes;
  for (int k = 0; k < 8; ++k)
    slopes.push_back(-(m.x * std::cos(2 * pi * k / 8) + m.y * std::sin(2 * pi * k / 8)) / m.z);
  const StoredHorizons<double> horizons(slopes.data(), slopes.size());
  for (int i = 0; i < 100; ++i) {
    const double azimuth = 2 * pi * i / 100;
    const Unit d = unit(std::cos(azimuth), std::sin(azimuth), 0.8 * std::sin(0.7 * i));
    CHECK((horizons.above(d) > 0) == (dot(m, d) > 0));  // identity
    const double sectors = azimuth / (2 * pi) * 8;
    const auto k = static_cast<std::size_t>(sectors);
    CHECK(horizons.slope(k, sectors - std::floor(sectors)) ==
          Approx(-(m.x * std::cos(azimuth) + m.y * std::sin(azimuth)) / m.z).margin(1e-12));  // identity
  }
}

TEST_CASE("horizons of a round pit seen from above leave a disc of slopes", "[gloss]") {
  // Half vectors of directions up to c from the normal have slopes up to t = tan(c/2), of which GGX has
  // t²/(t² + r²); those above the horizontal 1/(1 + r²).
  constexpr std::size_t kMany = 512;
  for (const double elevation : {0.2, 0.8, 1.3, 1.5}) {
    const std::vector<double> slopes(kMany, std::tan(elevation));
    const StoredHorizons<double> horizons(slopes.data(), kMany);
    for (const double roughness : {0.05, 0.3, 1.0}) {
      const double t = std::tan((pi / 2 - elevation) / 2);
      const double expected = t * t / (t * t + roughness * roughness) * (1 + roughness * roughness);
      CHECK(horizon_polygon_occlusion<double>({0, 0, 1}, {0, 0, 1}, roughness, horizons) ==
            Approx(expected).epsilon(2e-4));  // discretisation: a polygon for a circle
    }
  }
}

TEST_CASE("horizons count lobes as integrating them does", "[gloss]") {
  // A ring that stands at 0.9 on one side and at 0.1 on the other, stored finely.
  constexpr std::size_t kMany = 512;
  const auto ring = [](double azimuth) { return 0.5 + 0.4 * std::sin(azimuth); };
  std::vector<double> slopes;
  for (std::size_t k = 0; k < kMany; ++k)
    slopes.push_back(std::tan(ring(2 * pi * static_cast<double>(k) / kMany)));
  const StoredHorizons<double> horizons(slopes.data(), kMany);
  std::vector<LobeSample> samples;
  for (const Unit view : {unit(0, 0, 1), unit(0.8, 0.3, 0.7), unit(-0.2, 0.9, 0.3), unit(0.9, -0.6, 0.2)}) {
    for (const double roughness : {0.05, 0.4, 1.0}) {
      constexpr int kSamples = 200000;
      sample_ggx({.roughness = roughness}, {view.x, view.y, view.z}, kSamples, {0.4, 0.1}, samples);
      double normals = 0;
      double open_normals = 0;
      double whole = 0;
      double open = 0;
      for (const LobeSample& sample : samples) {
        if (sample.direction.z() <= 0) continue;
        const double azimuth = std::atan2(sample.direction.y(), sample.direction.x());
        const bool is_open = std::asin(sample.direction.z()) > ring(azimuth);
        normals += 1;
        whole += sample.weight;
        open_normals += is_open ? 1 : 0;
        open += is_open ? sample.weight : 0;
      }
      INFO(view.z << " " << roughness);
      // Monte Carlo: lattices of 2·10⁵ and 2·10⁴
      CHECK(horizon_polygon_occlusion<double>({0, 0, 1}, view, roughness, horizons) ==
            Approx(open_normals / normals).margin(2e-3));
      CHECK(horizon_occlusion<double>({0, 0, 1}, view, roughness, horizons, 20000) ==
            Approx(open / whole).margin(2e-3));
    }
  }
}

}  // namespace heightlight
