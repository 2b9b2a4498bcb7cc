#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/parallel.h"
#include "heightlight/error.h"
#include "heightlight/sky_light.h"
#include "heightlight/solve.h"
#include "test_maps.h"

using namespace heightlight;
using std::numbers::pi;

namespace {

Surface open_plain(int side, double slope) {
  Heightmap map{.height = Image<float>(side, side), .spacing = {1, 1}, .boundary = Boundary::open};
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column)
      map.height(row, column) = static_cast<float>(slope * column);
  }
  return build_surface(std::move(map));
}

Heightmap synth_map(const char* shape, int side, float relief) {
  return make_map(side, side, Boundary::tile, [&, heights = synthesize(shape, side, 1)](int row, int column) {
    return relief * heights(row, column);
  });
}

}  // namespace

TEST_CASE("over walked horizons an even sky sends A", "[skylight]") {
  const Surface surface = build_surface(synth_map("fbm", 64, 0.3F));
  const SkyLight even{Image<Vector3>(8, 4, Vector3{2, 2, 2})};
  const SkyIrradiance found = sky_irradiance(surface, even, {.error = 0.001});
  const Results sky = solve(surface, {.wanted = {.sky = true}, .accuracy = {.error = 0.0005}});
  REQUIRE(found.channels.size() == 1);
  double squares = 0;
  for (std::size_t i = 0; i < sky.sky_view_factor.size(); ++i) {
    const double error = found.channels[0][i] / 2 - double{sky.sky_view_factor.values[i]};
    squares += error * error;
  }
  CHECK(std::sqrt(squares / static_cast<double>(sky.sky_view_factor.size())) < 0.0012);  // both errors
  CHECK(found.rmse < 0.001);
}

TEST_CASE("an overcast sky lights a level plain as 1, and a tilted one by its integral", "[skylight]") {
  const SkyIrradiance level = sky_irradiance(open_plain(4, 0), overcast_sky());
  for (const double value : level.channels[0])
    CHECK(value == Approx(1).epsilon(1e-5));  // 512 rows of radiance

  // On a plane of tilt s: E/E₀ = 3/7 (1 + cos s)/2 + 4/7 ((1 + cos s)/2 with weight sinθ), by quadrature.
  const double tilt = std::atan(1.0);
  double integral = 0;
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i) {
    const double elevation = pi / 2 * (i + 0.5) / kSteps;
    for (int k = 0; k < kSteps; ++k) {
      const double azimuth = 2 * pi * (k + 0.5) / kSteps;
      const double cosine =
          std::sin(elevation) * std::cos(tilt) - std::cos(elevation) * std::cos(azimuth) * std::sin(tilt);
      integral += std::max(0.0, cosine) * 9 / 7 * (1 + 2 * std::sin(elevation)) / 3 * std::cos(elevation);
    }
  }
  integral *= pi / 2 / kSteps * 2 * pi / kSteps / pi;
  const SkyIrradiance tilted = sky_irradiance(open_plain(5, 1), overcast_sky());
  CHECK(tilted.channels[0][12] ==
        Approx(integral).epsilon(2e-4));  // azimuths, and the quadrature's own steps
}

TEST_CASE("a sky of colours has three channels, of any number of threads, and none where a sample is missing",
          "[skylight]") {
  Heightmap map = synth_map("brick", 40, 0.1F);
  map.height(3, 4) = std::numeric_limits<float>::quiet_NaN();
  const Surface surface = build_surface(map);
  const SkyIrradiance found = sky_irradiance(surface, two_tone_sky(), {.azimuths = 64});
  REQUIRE(found.channels.size() == 3);
  CHECK(found.channels[0][surface.map.height.index(3, 4)] == 0);
  const ThreadScope one(1);
  CHECK(sky_irradiance(surface, two_tone_sky(), {.azimuths = 64}).channels == found.channels);
  CHECK_THROWS_AS(sky_irradiance(surface, {Image<Vector3>(3, 2)}), UsageError);
}
