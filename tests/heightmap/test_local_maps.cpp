#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "base/parallel.h"
#include "heightmap/gaussian_mean.h"
#include "heightmap/mean_curvature.h"
#include "test_maps.h"

namespace heightlight {
namespace {

/// Heights by their place, (0, 0) in the middle, 1 wide, with cells of 1 : 2.
Image<double> heights_of(int width, const std::function<double(double x, double y)>& height) {
  Image<double> heights(width, width / 2);
  for (int row = 0; row < heights.height; ++row) {
    for (int column = 0; column < width; ++column) {
      const double x = (column + 0.5) / width - 0.5;
      const double y = 0.5 - (row + 0.5) / heights.height;
      heights(row, column) = height(x, y);
    }
  }
  return heights;
}

/// Largest error of the curvature where x² + y² < 0.3², away from edges.
double largest_error(int width, double truth, const std::function<double(double x, double y)>& height) {
  const Map found = mean_curvature(heights_of(width, height), {1.0 / width, 2.0 / width}, Boundary::open);
  double largest = 0;
  for (int row = 0; row < found.height; ++row) {
    for (int column = 0; column < width; ++column) {
      if (std::hypot((column + 0.5) / width - 0.5, 0.5 - (row + 0.5) / found.height) > 0.3) continue;
      largest = std::max(largest, std::fabs(double{found(row, column)} - truth));
    }
  }
  return largest;
}

TEST_CASE("spheres and cylinders have their mean curvature, to second order of the texel", "[heightmap]") {
  const double radius = 0.6;
  const auto sphere = [&](double x, double y) { return std::sqrt(radius * radius - x * x - y * y); };
  const auto bowl = [&](double x, double y) { return -sphere(x, y); };
  const auto cylinder = [&](double x, double y) {
    const double across = 0.6 * x + 0.8 * y;  // its axis lies askew, so that h_xy counts
    return std::sqrt(radius * radius - across * across);
  };
  const auto plane = [](double x, double y) { return 2 * x - 3 * y; };
  for (const auto& [truth, height] :
       {std::pair<double, std::function<double(double, double)>>{1 / radius, sphere},
        {-1 / radius, bowl},
        {0.5 / radius, cylinder}}) {
    const double coarse = largest_error(64, truth, height);
    const double fine = largest_error(128, truth, height);
    CHECK(fine < 0.01 * std::fabs(truth));  // discretisation
    CHECK(coarse / fine == Approx(4).epsilon(0.1));
  }
  CHECK(largest_error(64, 0, plane) < 1e-9);  // rounding
}

TEST_CASE("planes are flat up to open edges and holes, and holes have no curvature", "[heightmap]") {
  Image<double> heights = heights_of(32, [](double x, double y) { return x + y; });
  heights(7, 9) = std::numeric_limits<double>::quiet_NaN();
  const Map curvature = mean_curvature(heights, {1.0 / 32, 1.0 / 16}, Boundary::open);
  for (std::size_t i = 0; i < curvature.size(); ++i) {
    if (i == heights.index(7, 9)) {
      CHECK(std::isnan(curvature.values[i]));
    } else {
      CHECK(std::fabs(curvature.values[i]) < 1e-5F);
    }
  }
}

TEST_CASE("a wave that tiles loses exp(-k² sigma²/2) to the Gaussian mean", "[heightmap]") {
  constexpr int kSide = 128;
  Heightmap map{.height = Image<float>(kSide, kSide), .spacing = {1.0 / kSide, 0.5 / kSide}};
  const double k = 2 * std::numbers::pi * 4;
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column)
      map.height(row, column) =
          static_cast<float>(std::sin(k * (column * map.spacing.x + row * map.spacing.y)));
  }
  const double sigma = 0.03;
  const double left = std::exp(-k * k * sigma * sigma);  // along both axes
  const Image<double> mean = gaussian_mean(map, sigma);
  for (std::size_t i = 0; i < mean.size(); ++i)
    REQUIRE(mean.values[i] == Approx(left * double{map.height.values[i]}).margin(5e-4));  // what is cut off
}

TEST_CASE("a Gaussian mean keeps what is level, leaves out holes, and does not hang on threads",
          "[heightmap]") {
  Heightmap map = make_rough_map(37, 23, Boundary::open, 0.2, 0.05, 3);
  const double sigma = 3 * map.spacing.x;
  Image<double> one;
  {
    const ThreadScope scope(1);
    one = gaussian_mean(map, sigma);
  }
  const ThreadScope scope(3);
  const Image<double> three = gaussian_mean(map, sigma);
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK(std::isnan(one.values[i]) == std::isnan(map.height.values[i]));
    if (!std::isnan(one.values[i])) CHECK(one.values[i] == three.values[i]);
  }
  for (float& height : map.height.values) height = std::isnan(height) ? height : 0.25F;
  for (const double mean : gaussian_mean(map, sigma).values) {
    if (!std::isnan(mean)) CHECK(mean == Approx(0.25).epsilon(1e-12));
  }
}

}  // namespace
}  // namespace heightlight
