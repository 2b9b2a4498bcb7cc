#include "shading/directional_methods.h"

#include <cmath>
#include <numbers>

#include "base/gauss_legendre.h"
#include "base/parallel.h"

namespace heightlight {
namespace {

double norm_of(const NineHarmonics<double>& a) { return std::sqrt(dot(a, a)); }

NineHarmonics<double> difference(const NineHarmonics<double>& a, const NineHarmonics<double>& b) {
  NineHarmonics<double> rest = a;
  for (std::size_t i = 0; i < rest.size(); ++i) rest.at(i) -= b.at(i);
  return rest;
}

/// (1/π) ∫ (n·ω)⁺ Y dω over a cone about z, n turned toward x.
NineHarmonics<double> integrate_cone_cosine(double half_angle, double turn) {
  constexpr int kAround = 256;
  static const std::vector<QuadratureNode> kNodes = gauss_legendre(64);
  NineHarmonics<double> sum{};
  const double span = 1 - std::cos(half_angle);
  for (const QuadratureNode& node : kNodes) {
    const double z = 1 - node.at * span;
    const double sine = std::sqrt(1 - z * z);
    for (int step = 0; step < kAround; ++step) {
      const double azimuth = 2 * std::numbers::pi * (step + 0.5) / kAround;
      const Direction<double> d{sine * std::cos(azimuth), sine * std::sin(azimuth), z};
      const double cosine = std::max(0.0, d.x * std::sin(turn) + d.z * std::cos(turn));
      const double weight = node.weight * span * 2 / kAround * cosine;
      const NineHarmonics<double> y = harmonics_along(d);
      for (std::size_t i = 0; i < sum.size(); ++i) sum.at(i) += weight * y.at(i);
    }
  }
  return sum;
}

/// The product of two functions, in nine harmonics.
NineHarmonics<double> multiply(const NineHarmonics<double>& a, const NineHarmonics<double>& b) {
  NineHarmonics<double> product{};
  for (std::size_t i = 0; i < product.size(); ++i) {
    NineHarmonics<double> one{};
    one.at(i) = 1;
    product.at(i) = triple_product(one, a, b);
  }
  return product;
}

}  // namespace

std::vector<ConeFormError> judge_cone_forms(int steps) {
  std::vector<ConeFormError> errors(static_cast<std::size_t>(steps) * static_cast<std::size_t>(steps));
  parallel_for(steps * steps, [&](std::int64_t i) {
    const double step = std::numbers::pi / 2 / steps;
    const double half_angle = step * static_cast<double>(i / steps + 1);
    const double turn = step * static_cast<double>(i % steps + 1);
    const Direction<double> normal{std::sin(turn), 0, std::cos(turn)};
    const NineHarmonics<double> truth = integrate_cone_cosine(half_angle, turn);
    const double cosine = std::cos(half_angle);
    const NineHarmonics<double> cone = cone_harmonics<double>(SkyViewFactor(1 - cosine * cosine), {0, 0, 1});
    const NineHarmonics<double> product = multiply(turn_zonal<double>(cap_zonal_harmonics(cosine), {0, 0, 1}),
                                                   cone_harmonics(SkyViewFactor(1.0), normal));
    errors[static_cast<std::size_t>(i)] = {half_angle, turn,
                                           norm_of(difference(cone, truth)) / norm_of(truth),
                                           norm_of(difference(product, truth)) / norm_of(truth)};
  });
  return errors;
}

}  // namespace heightlight
