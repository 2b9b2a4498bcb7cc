#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/hash.h"
#include "base/texel_algebra.h"
#include "heightlight/error.h"
#include "heightlight/sky_light.h"
#include "skylight/sky_slices.h"
#include "test_maps.h"
#include "visibility/exact_walk.h"

// Light of skies that are not the same all over.

namespace heightlight {
namespace {

using Catch::Contains;

constexpr double kPi = std::numbers::pi;

/// Of random texels.
SkyLight random_sky(int rows) {
  SkyLight sky{Image<Vector3>(2 * rows, rows)};
  std::uint64_t random = 5;
  const auto next = [&] { return static_cast<float>(unit_real(random = scramble(random))); };
  for (Vector3& radiance : sky.radiance.values) radiance = {next(), 10 * next(), next() > 0.9F ? 30.0F : 0};
  return sky;
}

/// E/π by the midpoint rule over azimuths and elevations, looking up the sky direction by direction.
Eigen::Vector3d integrate(const SkyLight& sky, const Eigen::Vector3d& normal,
                          const std::vector<double>& horizon_rad) {
  constexpr int kParts = 16;  // of a slice, and of it from the nadir to the zenith per degree
  constexpr int kElevations = 180 * kParts;
  const auto slices = static_cast<int>(horizon_rad.size());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < slices * kParts; ++i) {
    const double azimuth = 2 * kPi * (0.25 - 0.5 + (i + 0.5) / kParts) / slices;
    for (int j = 0; j < kElevations; ++j) {
      const double elevation = kPi * ((j + 0.5) / kElevations - 0.5);
      const Eigen::Vector3d way(std::cos(elevation) * std::cos(azimuth),
                                std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const double cosine = way.dot(normal);
      if (cosine <= 0 || elevation < horizon_rad[static_cast<std::size_t>(i / kParts)]) continue;
      const Vector3 radiance = radiance_from(sky, to_vector3(way.cast<float>()));
      sum += as_eigen(radiance).cast<double>() * cosine * std::cos(elevation);
    }
  }
  return sum * (2 * kPi / (slices * kParts)) * (kPi / kElevations) / kPi;
}

TEST_CASE("a sky is a panorama that looks up the map in the middle", "[skylight]") {
  SkyLight sky{Image<Vector3>(8, 4)};
  const auto lit = [&](int row, int column, const Vector3& way) {
    SkyLight one = sky;
    one.radiance(row, column) = {1, 2, 3};
    return radiance_from(one, way) == Vector3{1, 2, 3};
  };
  CHECK(lit(1, 4, {0.3F, 1, 0.1F}));   // right of the middle, above the horizon: a little east of +y
  CHECK(lit(1, 6, {1, -0.3F, 0.1F}));  // +x at three quarters
  CHECK(lit(1, 5, {1, 0.3F, 0.1F}));
  CHECK(lit(1, 1, {-1, -0.3F, 0.1F}));
  CHECK(lit(0, 0, {-0.01F, -0.1F, 1}));
  CHECK(lit(2, 4, {0.3F, 1, -0.1F}));
  CHECK(lit(3, 7, {0.1F, -0.2F, -5}));
}

TEST_CASE("an even sky sends A", "[skylight]") {
  const Surface surface = build_surface(make_rough_map(24, 20, Boundary::open, 0.1, 0.2, 3));
  const ExactWalker walker(surface, 32);
  const SkySlices even({Image<Vector3>(6, 3, Vector3{1, 0.5F, 0})}, 32);
  SliceView view;
  for (int row = 0; row < surface.height(); ++row) {
    for (int column = 0; column < surface.width(); ++column) {
      walker.view(row, column, view);
      if (view.horizon_rad.empty()) continue;
      const Eigen::Vector3d normal = as_eigen(surface.normal(row, column)).cast<double>().normalized();
      const Eigen::Vector3d light = even.irradiance(normal, view.horizon_rad);
      REQUIRE(light.x() == Approx(view.sky_view_factor).margin(1e-6));  // the normal is made of floats
      REQUIRE(light.y() == Approx(view.sky_view_factor / 2).margin(1e-6));
      REQUIRE(light.z() == 0);
    }
  }
}

TEST_CASE("light over horizons is the integral over directions", "[skylight]") {
  const int rows = GENERATE(1, 7, 40);
  const SkyLight sky = random_sky(rows);
  constexpr int kAzimuths = 64;
  const SkySlices slices(sky, kAzimuths);
  std::vector<double> horizons(kAzimuths);
  std::uint64_t random = 8;
  for (double& horizon : horizons) horizon = unit_real(random = scramble(random)) * 1.8 - 0.4;
  for (const Eigen::Vector3d& way : {Eigen::Vector3d(0, 0, 1), {0.4, -0.2, 0.8}, {-2, 1, 0.5}}) {
    const Eigen::Vector3d normal = way.normalized();
    const Eigen::Vector3d found = slices.irradiance(normal, horizons);
    const Eigen::Vector3d expected = integrate(sky, normal, horizons);
    INFO(rows << " rows, normal " << normal.transpose());
    CHECK((found - expected).cwiseAbs().maxCoeff() < 0.01 * expected.maxCoeff());  // azimuths of a slice
  }
}

TEST_CASE("a prefiltered sky is what open planes receive", "[skylight]") {
  const SkyLight open = open_irradiance(two_tone_sky(), 32);
  for (const Vector3& normal : {Vector3{0, 0, 1}, {0, 1, 0}, {0, -1, 0}, {0.6F, 0.48F, 0.64F}}) {
    const double warm =
        (1 + double{normal.y}) / 2;  // of a hemisphere, what lies beyond a plane through its middle
    const Vector3 found = look_up(open, normal);
    CHECK(double{found.x} == Approx(warm + 0.3 * (1 - warm)).margin(0.002));  // between texels
    CHECK(double{found.y} == Approx(0.6).margin(1e-6));
    CHECK(double{found.z} == Approx(0.3 * warm + 1 - warm).margin(0.002));
  }
}

TEST_CASE("a prefiltered sun is there from all sides, and loses no light", "[skylight]") {
  // Far smaller than the directions that sums go over.
  SkyLight sun{Image<Vector3>(4096, 2048)};
  sun.radiance(700, 1000) = {1e6F, 0, 0};
  const SkyLight unit = normalised(sun);
  CHECK(double{look_up(open_irradiance(unit, 32), {0, 0, 1}).x} == Approx(3).epsilon(0.02));
  const SkySlices slices(unit, 128);
  const std::vector<double> open(128, -kPi / 2);
  CHECK(slices.irradiance({0, 0, 1}, open).x() == Approx(3).epsilon(1e-4));
}

TEST_CASE("a renderer's grid has the mean over what a direction stands for", "[skylight]") {
  const double angle = GENERATE(0.01, 0.4, 2 * kPi);
  const SkyGrid grid = make_sky_grid(two_tone_sky(), angle);
  const auto at = [&](int row, int column) {
    return grid.red[static_cast<std::size_t>(row * grid.side + column)];
  };
  const int middle = grid.side / 2;
  CHECK(at(middle, middle) == Approx(0.65).margin(angle < 0.1 ? 0.36 : 0.05));  // beside the zenith
  CHECK(at(grid.side - 1, middle) > at(middle, middle));                        // toward +y
  CHECK(at(grid.side - 1, middle) == Approx(1).margin(0.01));  // the cell faces 1° away from y
  CHECK(at(0, middle) == Approx(0.3).margin(0.01));
}

TEST_CASE("what is no sky is refused", "[skylight]") {
  CHECK_THROWS_WITH(check_sky_light({Image<Vector3>(4, 4)}), Contains("4 × 4"));
  CHECK_THROWS_WITH(check_sky_light({}), Contains("0 × 0"));
  for (const float bad : {-1.0F, std::numeric_limits<float>::infinity(), std::nanf("")}) {
    SkyLight sky = two_tone_sky();
    sky.radiance(1, 2).y = bad;
    CHECK_THROWS_AS(check_sky_light(sky), UsageError);
  }
  CHECK_THROWS_AS(make_sky_grid(two_tone_sky(), 0), UsageError);
  CHECK(normalised({Image<Vector3>(2, 1)}).radiance(0, 0) == Vector3{});
}

}  // namespace
}  // namespace heightlight
