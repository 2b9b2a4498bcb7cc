#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/parallel.h"
#include "heightlight/error.h"
#include "heightlight/sun.h"
#include "test_maps.h"

// The sun: exact shadows, and penumbras as wide as its disc makes them.

namespace heightlight {
namespace {

constexpr double kRight = std::numbers::pi / 2;

/// The share of a disc of radius 1 that lies beyond a straight edge at `edge` from its middle.
double share_beyond(double edge) {
  if (edge >= 1) return 0;
  if (edge <= -1) return 1;
  return (std::acos(edge) - edge * std::sqrt(1 - edge * edge)) / std::numbers::pi;
}

TEST_CASE("a level open plain receives the sine of the sun's elevation", "[skylight][sun]") {
  const Surface plain = build_surface(make_map(7, 5, Boundary::open, [](int, int) { return 2.5; }));
  for (const double elevation : {0.05, 0.3, 0.5236, 1.0, 1.5, kRight}) {
    for (const double diameter : {0.0, 0.0093, 0.1}) {
      const TexelVector light =
          sun_irradiance(plain, {.azimuth_rad = 0.7, .elevation_rad = elevation, .diameter_rad = diameter});
      for (const double value : light) CHECK(value == Approx(std::sin(elevation)).margin(1e-12));  // identity
    }
  }
}

TEST_CASE("half of a sun on the horizontal shines on a level plain", "[skylight][sun]") {
  const Surface plain = build_surface(make_map(3, 3, Boundary::open, [](int, int) { return 0; }));
  const double radius = 0.005;
  const TexelVector light =
      sun_irradiance(plain, {.azimuth_rad = 0, .elevation_rad = 0, .diameter_rad = 2 * radius});
  // Closed: ∫ of y over half a disc, 2/3 r³, over its area. Quadrature of five chords whose mean is of sin²θ
  // sinθ.
  CHECK(light[4] == Approx(2 * radius / (3 * std::numbers::pi)).epsilon(0.01));
}

TEST_CASE("a wall's shadow ends in the penumbra of a disc", "[skylight][sun]") {
  constexpr int kRim = 20;  // the last column of the wall
  constexpr double kWall = 200;
  Heightmap map =
      make_map(700, 25, Boundary::open, [&](int, int column) { return column <= kRim ? kWall : 0; });
  map.spacing = {1, 1};
  const Surface surface = build_surface(map);
  const double elevation = GENERATE(0.35, 0.5, 0.8);
  const Sun sun{.azimuth_rad = std::numbers::pi, .elevation_rad = elevation};
  const double radius = sun.diameter_rad / 2;
  const TexelVector light = sun_irradiance(surface, sun);
  int in_penumbra = 0;
  for (int column = kRim + 3; column < 698; ++column) {
    const double share = light[map.height.index(12, column)] / std::sin(elevation);
    const double edge = (std::atan(kWall / (column - kRim)) - elevation) / radius;
    // Quadrature: at most 23 chords of a level edge; and the disc's middle stands for its cosine, r.
    CHECK(share == Approx(share_beyond(edge)).margin(1e-3 + radius));
    if (edge >= 1) CHECK(share == 0);
    if (edge <= -1.02) CHECK(share == Approx(1).margin(1e-12));
    in_penumbra += share > 0 && share < 1 - 1e-9 ? 1 : 0;
  }
  const double width = kWall / std::tan(elevation - radius) - kWall / std::tan(elevation + radius);
  CHECK(std::fabs(in_penumbra - width) < 1.5);  // whole texels
  const TexelVector point = sun_irradiance(
      surface, {.azimuth_rad = std::numbers::pi, .elevation_rad = elevation, .diameter_rad = 0});
  for (int column = kRim + 3; column < 698; ++column) {
    const bool is_lit = column - kRim > kWall / std::tan(elevation);
    CHECK(point[map.height.index(12, column)] == Approx(is_lit ? std::sin(elevation) : 0).margin(1e-12));
  }
}

TEST_CASE("the penumbra of an upright edge errs by one chord", "[skylight][sun]") {
  constexpr int kEdge = 40;  // the first row beside the tower
  Heightmap map = make_map(1600, 80, Boundary::open,
                           [&](int row, int column) { return column < 4 && row < kEdge ? 1e6 : 0; });
  map.spacing = {1, 1};
  const Surface surface = build_surface(map);
  const Sun sun{.azimuth_rad = std::numbers::pi, .elevation_rad = 0.4};
  const TexelVector light = sun_irradiance(surface, sun);
  double sum = 0;
  double largest = 0;
  int count = 0;
  for (int column = 1000; column < 1598; ++column) {
    for (int row = 12; row < 68; ++row) {  // farther out, directions leave the map
      // The tower is so high that its side is upright where the sun stands: at the row of kEdge.
      const double offset = (kEdge - row) / static_cast<double>(column - 3);
      const double edge = offset * std::cos(sun.elevation_rad) / (sun.diameter_rad / 2);
      const double error =
          light[map.height.index(row, column)] / std::sin(sun.elevation_rad) - share_beyond(edge);
      if (std::fabs(edge) > 1.1) {
        CHECK(std::fabs(error) < 1e-12);
        continue;
      }
      sum += error;
      largest = std::max(largest, std::fabs(error));
      ++count;
    }
  }
  REQUIRE(count > 1000);
  CHECK(largest < 1.0 / 24 + 0.01);  // half of the middle chord's weight, and what its bending leaves
  CHECK(largest > 0.01);
  CHECK(std::fabs(sum / count) < 0.004);
}

TEST_CASE("a slope that leans away from the sun is dark, one toward it is bright", "[skylight][sun]") {
  const Surface slope =
      build_surface(make_map(9, 9, Boundary::open, [](int, int column) { return column / 9.0; }));
  const Sun behind{.azimuth_rad = 0, .elevation_rad = 0.6};  // the slope rises by 45 degrees toward x
  for (const double value : sun_irradiance(slope, behind)) CHECK(value == 0);
  const Sun before{.azimuth_rad = std::numbers::pi, .elevation_rad = 0.6};
  const double expected = std::cos(std::numbers::pi / 4 - 0.6);
  for (const double value : sun_irradiance(slope, before)) CHECK(value == Approx(expected).margin(1e-6));
}

TEST_CASE("the sun goes with a map that is turned", "[skylight][sun]") {
  // Heights that are a sum of one function of the row and one of the column make every cell a plane,
  // whichever way it is cut.
  constexpr int kSize = 24;
  const auto step = [](int i) { return 0.15 * unit_real(scramble(static_cast<std::uint64_t>(i))); };
  const auto height = [&](int row, int column) {
    return row == 5 && column == 7 ? std::nan("") : step(row) + step(100 + column);
  };
  const Surface surface = build_surface(make_map(kSize, kSize, Boundary::open, height));
  // Counterclockwise by a right angle: what was at (row, column) comes to (size − 1 − column, row).
  const Surface turned = build_surface(make_map(
      kSize, kSize, Boundary::open, [&](int row, int column) { return height(column, kSize - 1 - row); }));
  const double azimuth = GENERATE(0.4, 2.0, 4.5);
  const TexelVector light = sun_irradiance(surface, {.azimuth_rad = azimuth, .elevation_rad = 0.5});
  const TexelVector again = sun_irradiance(turned, {.azimuth_rad = azimuth + kRight, .elevation_rad = 0.5});
  int different = 0;
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const double before = light[surface.map.height.index(row, column)];
      const double after = again[surface.map.height.index(kSize - 1 - column, row)];
      different += std::fabs(before - after) > 1e-6 ? 1 : 0;  // identity: normals are floats
    }
  }
  CHECK(different == 0);
  CHECK(light[surface.map.height.index(5, 7)] == 0);
}

TEST_CASE("the sun is the same for any number of threads", "[skylight][sun]") {
  const Surface surface = build_surface(make_rough_map(40, 30, Boundary::open, 0.1, 0.1, 3));
  const Sun sun{.azimuth_rad = 1, .elevation_rad = 0.4};
  const auto with_threads = [&](int threads) {
    const ThreadScope scope(threads);
    return sun_irradiance(surface, sun);
  };
  const TexelVector one = with_threads(1);
  CHECK(one == with_threads(3));
  CHECK(*std::max_element(one.begin(), one.end()) > 0.5);
  CHECK(std::count(one.begin(), one.end(), 0.0) > 100);
}

TEST_CASE("a sun that cannot be is refused", "[skylight][sun]") {
  const Surface plain = build_surface(make_map(3, 3, Boundary::open, [](int, int) { return 0; }));
  for (const Sun& sun : std::vector<Sun>{{.elevation_rad = -0.01},
                                         {.elevation_rad = 1.6},
                                         {.elevation_rad = std::nan("")},
                                         {.azimuth_rad = HUGE_VAL, .elevation_rad = 1},
                                         {.elevation_rad = 1, .diameter_rad = -0.1},
                                         {.elevation_rad = 1, .diameter_rad = 0.2}}) {
    CHECK_THROWS_AS(sun_irradiance(plain, sun), UsageError);
  }
  Watch watch;
  watch.stopped = [] { return true; };
  CHECK_THROWS_AS(sun_irradiance(plain, {.elevation_rad = 1}, watch), Cancelled);
}

}  // namespace
}  // namespace heightlight
