#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "base/hash.h"
#include "visibility/slice_integrals.h"

namespace heightlight {
namespace {

/// Gauss–Legendre with five nodes on each of 64 pieces: exact to rounding for the products of sines below.
double integrate(double from, double to, const std::function<double(double)>& f) {
  constexpr double kNode[] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                              0.9061798459386640};
  constexpr double kWeight[] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                0.4786286704993665, 0.2369268850561891};
  constexpr int kPieces = 64;
  const double half = (to - from) / kPieces / 2;
  double sum = 0;
  for (int piece = 0; piece < kPieces; ++piece) {
    const double middle = from + (2 * piece + 1) * half;
    for (int i = 0; i < 5; ++i) sum += kWeight[i] * half * f(middle + kNode[i] * half);
  }
  return sum;
}

/// A normal in some slice, a random one per index: tilted by up to a right angle, towards any side.
SliceNormal random_normal(std::uint64_t index) {
  const double tilt = std::numbers::pi / 2 * unit_real(scramble(index));
  const double side = 2 * std::numbers::pi * unit_real(scramble(index + 1000));
  return {std::sin(tilt) * std::cos(side), std::cos(tilt)};
}

struct Interval {
  double from_rad, to_rad;
};

/// Two random elevations above the tangent plane.
Interval random_interval(const SliceNormal& normal, std::uint64_t index) {
  const double tangent = std::atan(tangent_slope(normal));
  const double a = tangent + (std::numbers::pi / 2 - tangent) * unit_real(scramble(index + 2000));
  const double b = tangent + (std::numbers::pi / 2 - tangent) * unit_real(scramble(index + 3000));
  return {std::min(a, b), std::max(a, b)};
}

double cosine_to_normal(const SliceNormal& normal, double elevation) {
  return normal.along * std::cos(elevation) + normal.up * std::sin(elevation);
}

TEST_CASE("the slices' closed forms are the integrals that they stand for", "[visibility]") {
  for (std::uint64_t i = 0; i < 500; ++i) {
    const SliceNormal normal = random_normal(i);
    const auto [a, b] = random_interval(normal, i);
    const Elevation from = elevation_of_slope(std::tan(a));
    const Elevation to = elevation_of_slope(std::tan(b));
    const double mass =
        integrate(a, b, [&](double theta) { return cosine_to_normal(normal, theta) * std::cos(theta); });
    // identity: some 10 roundings of values up to 2, and the tangents' own
    CHECK(cosine_mass(normal, from, to) == Approx(mass).margin(1e-14).epsilon(1e-12));
    CHECK(solid_angle_above(from) == Approx(integrate(a, std::numbers::pi / 2, [](double theta) {
                                       return std::cos(theta);
                                     })).epsilon(1e-12));
    const Eigen::Vector2d bent = bent_mass_above(normal, from);
    const auto towards_normal = [&](double theta) {
      return cosine_to_normal(normal, theta) * std::cos(theta);
    };
    const double along = integrate(a, std::numbers::pi / 2,
                                   [&](double theta) { return towards_normal(theta) * std::cos(theta); });
    const double up = integrate(a, std::numbers::pi / 2,
                                [&](double theta) { return towards_normal(theta) * std::sin(theta); });
    CHECK(bent.x() == Approx(along).margin(1e-14).epsilon(1e-12));
    CHECK(bent.y() == Approx(up).margin(1e-14).epsilon(1e-12));
  }
}

TEST_CASE("a stretch's light comes from where its weighted mean lies", "[visibility]") {
  double worst_narrow = 0;
  double worst_wide = 0;
  for (std::uint64_t i = 0; i < 500; ++i) {
    const SliceNormal normal = random_normal(i);
    const auto [a, b] = random_interval(normal, i);
    const double from_way = 1;
    const double to_way = 1 + 2 * unit_real(scramble(i + 4000));
    // The stretch from (1, tan a) to (s, s tan b): at elevation θ its share is where it has that slope.
    const double rise = to_way * std::tan(b) - std::tan(a);
    const auto share_at = [&, from = a](double theta) {
      return (std::tan(theta) - std::tan(from)) / (rise - (to_way - from_way) * std::tan(theta));
    };
    const auto weight_at = [&](double theta) { return cosine_to_normal(normal, theta) * std::cos(theta); };
    const double expected =
        integrate(a, b, [&](double theta) { return share_at(theta) * weight_at(theta); }) /
        integrate(a, b, weight_at);
    const double share = mean_share(normal, elevation_of_slope(std::tan(a)), elevation_of_slope(std::tan(b)),
                                    from_way, to_way);
    double& worst = b - a < 0.5 ? worst_narrow : worst_wide;
    worst = std::max(worst, std::fabs(share - expected));
  }
  // discretisation: three nodes. Shares of a stretch, which is no longer than a cell; the worst are stretches
  // whose far end, three times as far away as the near one, is seen near the zenith.
  CHECK(worst_narrow < 0.01);
  CHECK(worst_wide < 0.04);
}

TEST_CASE("below the tangent plane the cosine is negative, above it positive", "[visibility]") {
  for (std::uint64_t i = 0; i < 100; ++i) {
    const SliceNormal normal = random_normal(i);
    const double tangent = std::atan(tangent_slope(normal));
    CHECK(cosine_to_normal(normal, tangent - 1e-6) < 0);
    CHECK(cosine_to_normal(normal, tangent + 1e-6) > 0);
  }
}

TEST_CASE("the masses of neighbouring intervals add up, however short they are", "[visibility]") {
  const SliceNormal normal{0.6, 0.7};
  constexpr int kIntervals = 100'000;
  const double lowest = tangent_slope(normal);
  double sum = 0;
  double smallest = 1;
  Elevation from = elevation_of_slope(lowest);
  const Elevation whole = from;
  for (int k = 1; k <= kIntervals; ++k) {
    const Elevation to = elevation_of_slope(lowest + k * 1e-6);
    const double mass = cosine_mass(normal, from, to);
    smallest = std::min(smallest, mass);
    sum += mass;
    from = to;
  }
  CHECK(smallest > 0);
  // identity: √n·ε of the elevations' sines, which differ by 10⁻⁶ from one to the next
  CHECK(sum == Approx(cosine_mass(normal, whole, from)).epsilon(1e-13));
}

TEST_CASE("slices of the whole hemisphere sum to pi and 2 pi, and their bent normal is the normal",
          "[visibility]") {
  const double tilt = GENERATE(0.0, 0.3, 1.2);
  const Eigen::Vector3d normal(std::sin(tilt) * 0.6, std::sin(tilt) * 0.8, std::cos(tilt));
  constexpr int kAzimuths = 512;
  double mass = 0;
  double angle = 0;
  Eigen::Vector3d bent = Eigen::Vector3d::Zero();
  for (int k = 0; k < kAzimuths; ++k) {
    const double azimuth = 2 * std::numbers::pi * (k + 0.25) / kAzimuths;
    const Eigen::Vector2d d(std::cos(azimuth), std::sin(azimuth));
    const SliceNormal in_slice{normal.head<2>().dot(d), normal.z()};
    const Elevation tangent = elevation_of_slope(tangent_slope(in_slice));
    mass += cosine_mass(in_slice, tangent, {}) * 2 * std::numbers::pi / kAzimuths;
    angle += solid_angle_above(tangent) * 2 * std::numbers::pi / kAzimuths;
    const Eigen::Vector2d slice_bent = bent_mass_above(in_slice, tangent);
    bent.head<2>() += slice_bent.x() * d;
    bent.z() += slice_bent.y();
  }
  // The integrands are smooth and periodic in the azimuth, so that few slices do: what is left is rounding.
  CHECK(mass == Approx(std::numbers::pi).epsilon(1e-13));
  CHECK(angle == Approx(2 * std::numbers::pi).epsilon(1e-13));
  CHECK((bent.normalized() - normal).norm() < 1e-13);
}

TEST_CASE("towards the zenith small masses keep their digits", "[visibility]") {
  // With e = cos a: c/2 (δ − sin a cos a) = c (e³/3 + e⁵/10 + …), and 1 − sin a = e²/2 + e⁴/8 + e⁶/16 + …
  const SliceNormal normal{0.48, 0.8};
  for (const double slope : {1e3, 1e5, 1e7}) {
    const Elevation from = elevation_of_slope(slope);
    const double e = 1 / std::sqrt(1 + slope * slope);
    const double expected = 0.4 * e * e + 0.48 * (e * e * e / 3 + std::pow(e, 5) / 10);
    // identity: a few roundings
    CHECK(cosine_mass(normal, from, {}) == Approx(expected).epsilon(1e-14));
    CHECK(solid_angle_above(from) ==
          Approx(0.5 * e * e * (1 + e * e / 4 + e * e * e * e / 8)).epsilon(1e-14));
    CHECK(cosine_mass(normal, from, elevation_of_slope(2 * slope)) +
              cosine_mass(normal, elevation_of_slope(2 * slope), {}) ==
          Approx(expected).epsilon(1e-14));
  }
}

TEST_CASE("the nadir and the zenith are elevations too", "[visibility]") {
  const double infinity = std::numeric_limits<double>::infinity();
  const Elevation nadir = elevation_of_slope(-infinity);
  const Elevation zenith = elevation_of_slope(infinity);
  CHECK(solid_angle_above(nadir) == 2);
  CHECK(solid_angle_above(zenith) == 0);
  // A level normal: half a turn of cos²θ.
  CHECK(cosine_mass({1, 0}, nadir, zenith) == Approx(std::numbers::pi / 2).epsilon(1e-15));
  CHECK(tangent_slope({1, 0}) == -infinity);
  CHECK(tangent_slope({-1, 0}) == infinity);
  CHECK(tangent_slope({0, 0}) == 0);
}

}  // namespace
}  // namespace heightlight
