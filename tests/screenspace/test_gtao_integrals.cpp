#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "base/hash.h"
#include "published_gtao.h"
#include "visibility/slice_integrals.h"

// Jimenez et al. 2016, eqs. 7, 20 and 21 against numerical quadrature, and against the form that the kernels
// compute.

namespace heightlight {
namespace {

constexpr double kPi = std::numbers::pi;

/// Gauss–Legendre with five nodes on each of 64 pieces of either side of 0, where |sinθ| has its kink: exact
/// to rounding for products of sines.
double integrate(double from, double to, const std::function<double(double)>& f) {
  constexpr double kNode[] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                              0.9061798459386640};
  constexpr double kWeight[] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                0.4786286704993665, 0.2369268850561891};
  constexpr int kPieces = 64;
  double sum = 0;
  for (const auto& [a, b] : {std::pair{from, 0.0}, std::pair{0.0, to}}) {
    const double half = (b - a) / kPieces / 2;
    for (int piece = 0; piece < kPieces; ++piece) {
      const double middle = a + (2 * piece + 1) * half;
      for (int i = 0; i < 5; ++i) sum += kWeight[i] * half * f(middle + kNode[i] * half);
    }
  }
  return sum;
}

/// A normal tilted by up to 89° towards any side, a slice, and two horizons clamped to the hemisphere.
struct Situation {
  Eigen::Vector3d normal;
  double azimuth = 0;
  ProjectedNormal projected;
  double theta1 = 0, theta2 = 0;
};

Situation random_situation(std::uint64_t index) {
  const auto random = [index](std::uint64_t salt) { return unit_real(hash_combine(index, salt)); };
  Situation s;
  const double tilt = 89 * kPi / 180 * random(1);
  const double side = 2 * kPi * random(2);
  s.normal = {std::sin(tilt) * std::cos(side), std::sin(tilt) * std::sin(side), std::cos(tilt)};
  s.azimuth = kPi * random(3);
  s.projected = project_normal(s.normal, s.azimuth);
  s.theta1 = clamp_to_hemisphere(-kPi * random(4), s.projected.gamma);
  s.theta2 = clamp_to_hemisphere(kPi * random(5), s.projected.gamma);
  return s;
}

constexpr std::uint64_t kSituations = 2000;
constexpr double kRounding = 1e-13;  // identity: some hundred roundings of sums of order 1

TEST_CASE("equation 7 is the inner integral of equation 6", "[screenspace]") {
  for (std::uint64_t i = 0; i < kSituations; ++i) {
    const Situation s = random_situation(i);
    const double gamma = s.projected.gamma;
    const double expected = integrate(s.theta1, s.theta2, [gamma](double theta) {
      return std::cos(theta - gamma) * std::fabs(std::sin(theta));
    });
    REQUIRE(std::fabs(inner_integral(s.theta1, s.theta2, gamma) - expected) < kRounding);
  }
}

TEST_CASE("equations 20 and 21 are the inner integrals of equation 19", "[screenspace]") {
  for (std::uint64_t i = 0; i < kSituations; ++i) {
    const Situation s = random_situation(i);
    const double gamma = s.projected.gamma;
    const auto weight = [gamma](double theta) {
      return std::cos(theta - gamma) * std::fabs(std::sin(theta));
    };
    const Eigen::Vector2d bent = bent_integral(s.theta1, s.theta2, gamma);
    REQUIRE(std::fabs(bent.x() - integrate(s.theta1, s.theta2, [&](double theta) {
                        return std::sin(theta) * weight(theta);
                      })) < kRounding);
    REQUIRE(std::fabs(bent.y() - integrate(s.theta1, s.theta2, [&](double theta) {
                        return std::cos(theta) * weight(theta);
                      })) < kRounding);
  }
}

TEST_CASE("a slice's published integrals are those of the two azimuths that it spans", "[screenspace]") {
  for (std::uint64_t i = 0; i < kSituations; ++i) {
    const Situation s = random_situation(i);
    const Eigen::Vector2d d(std::cos(s.azimuth), std::sin(s.azimuth));
    double mass = 0;
    Eigen::Vector2d bent = Eigen::Vector2d::Zero();
    for (const double side : {-1.0, 1.0}) {
      const SliceNormal in_azimuth{side * s.normal.head<2>().dot(d), s.normal.z()};
      const double elevation = kPi / 2 - std::fabs(side < 0 ? s.theta1 : s.theta2);
      const Elevation horizon{std::cos(elevation), std::sin(elevation)};
      mass += cosine_mass(in_azimuth, horizon, Elevation{});
      const Eigen::Vector2d part = bent_mass_above(in_azimuth, horizon);
      bent += Eigen::Vector2d(side * part.x(), part.y());
    }
    const double length = s.projected.length;
    REQUIRE(std::fabs(length * inner_integral(s.theta1, s.theta2, s.projected.gamma) - mass) <
            10 * kRounding);
    REQUIRE((length * bent_integral(s.theta1, s.theta2, s.projected.gamma) - bent).norm() < 10 * kRounding);
  }
}

TEST_CASE("the integrals over slices of an open hemisphere are 1 and the normal itself", "[screenspace]") {
  for (std::uint64_t i = 0; i < 50; ++i) {
    const Eigen::Vector3d normal = random_situation(i).normal;
    constexpr int kSlices = 4096;
    double sum = 0;
    Eigen::Vector3d bent = Eigen::Vector3d::Zero();
    for (int k = 0; k < kSlices; ++k) {
      const double azimuth = kPi * k / kSlices;
      const ProjectedNormal projected = project_normal(normal, azimuth);
      const double theta1 = clamp_to_hemisphere(-kPi, projected.gamma);
      const double theta2 = clamp_to_hemisphere(kPi, projected.gamma);
      sum += projected.length * inner_integral(theta1, theta2, projected.gamma) / kSlices;
      const Eigen::Vector2d part = projected.length * bent_integral(theta1, theta2, projected.gamma);
      bent += Eigen::Vector3d(std::cos(azimuth) * part.x(), std::sin(azimuth) * part.x(), part.y());
    }
    // discretisation: 4096 slices of a smooth periodic function, exponentially small in n_z/√(1 − n_z²)
    CHECK(std::fabs(sum - 1) < 1e-12);
    CHECK((bent.normalized() - normal).norm() < 1e-12);
  }
}

TEST_CASE("equation 10's horizon above the horizontal darkens a tilted plane, line 18's does not",
          "[screenspace]") {
  const double tilt = GENERATE(0.2, 0.7, 1.3);
  const Eigen::Vector3d normal(std::sin(tilt), 0, std::cos(tilt));
  const double lowest = GENERATE(0.0, -1.0);  // what the cosine is at least: eq. 10, and line 18
  constexpr int kSlices = 4096;
  double sum = 0;
  for (int k = 0; k < kSlices; ++k) {
    const ProjectedNormal projected = project_normal(normal, kPi * (k + 0.5) / kSlices);
    const double horizon = std::acos(lowest);  // an open plane raises none
    sum += projected.length / kSlices *
           inner_integral(clamp_to_hemisphere(-horizon, projected.gamma),
                          clamp_to_hemisphere(horizon, projected.gamma), projected.gamma);
  }
  const double expected = lowest == 0 ? (1 + std::cos(tilt)) / 2 : 1;
  CHECK(sum == Approx(expected).epsilon(0).margin(1e-6));  // discretisation: a kink per half turn
}

TEST_CASE("the axis of line 10 projects only where the slice is square to the view vector", "[screenspace]") {
  const Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d normal = Eigen::Vector3d(0.3, 0.5, 0.8).normalized();
  const auto left_along_axis = [&](const Eigen::Vector3d& view) {
    const Eigen::Vector3d axis = direction.cross(view);
    const Eigen::Vector3d projected = normal - axis * normal.dot(axis);
    return std::fabs(projected.dot(axis.normalized()));
  };
  CHECK(left_along_axis(Eigen::Vector3d::UnitZ()) < 1e-15);                // identity
  CHECK(left_along_axis(Eigen::Vector3d(0.5, 0, 1).normalized()) > 0.09);  // a pixel 27° off the axis
}

}  // namespace
}  // namespace heightlight
