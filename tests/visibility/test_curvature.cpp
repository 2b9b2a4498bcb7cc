// The Earth's curvature, with refraction: κ = (1 − k)/2R.

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "heightlight/error.h"
#include "heightlight/solve.h"
#include "test_maps.h"
#include "visibility/exact_walk.h"

namespace heightlight {
namespace {

constexpr double kRadius = 6371008.8;

double kappa(double refraction) { return (1 - refraction) / (2 * kRadius); }

/// A sea of that many texels, with one peak in it.
Surface sea_with_peak(int width, int height, double texel, int row, int column, double peak,
                      double refraction) {
  Heightmap map = make_map(width, height, Boundary::open,
                           [&](int i, int j) { return i == row && j == column ? peak : 0.0; });
  map.spacing = {texel, texel};
  return build_surface(curve_heights(std::move(map), refraction));
}

TEST_CASE("a mountain beyond the sea stands lower by the Earth's curvature", "[visibility][curvature]") {
  const double refraction = GENERATE(0.0, 0.13);
  const int mountain = GENERATE(300, 999);  // seen from columns on both sides, far off the map's middle
  constexpr double kTexel = 100;
  constexpr double kPeak = 2500;
  const Surface surface = sea_with_peak(1001, 5, kTexel, 2, mountain, kPeak, refraction);
  Request request;
  request.wanted.horizon_rad = {0, std::numbers::pi};
  request.accuracy.visibility = Visibility::exact_slices;
  const Results results = solve(surface, request);
  for (const int column : {0, 1, 150, 500, 800, 1000}) {
    const double way = kTexel * (mountain - column);
    const double drop = kappa(refraction) * way * way;
    if (std::fabs(way) <= 2 * kTexel || drop >= kPeak) continue;
    const double found = double{results.horizons[way > 0 ? 0 : 1](2, column)};
    INFO("from column " << column << " to " << mountain);
    CHECK(found == Approx(std::atan((kPeak - drop) / std::fabs(way))).margin(1e-6));  // identity: floats
  }
}

TEST_CASE("fast walks see a plateau beyond the sea as the Earth's curvature leaves it",
          "[visibility][curvature]") {
  constexpr double kTexel = 250;
  constexpr double kHeight = 1000;
  constexpr int kEdge = 400;
  Heightmap map =
      make_map(512, 64, Boundary::open, [](int, int column) { return column < kEdge ? 0.0 : kHeight; });
  map.spacing = {kTexel, kTexel};
  const Surface surface = build_surface(curve_heights(std::move(map)));
  Request request;
  request.wanted.horizon_rad = {0};
  const Results results = solve(surface, request);
  for (const int column : {0, 40, 200, 300}) {
    const double way = kTexel * (kEdge - column);
    const double expected = std::atan(kHeight / way - kappa(kUsualRefraction) * way);
    INFO("from column " << column);
    CHECK(double{results.horizons[0](32, column)} ==
          Approx(expected).epsilon(0.12));  // discretisation: of blocks, a sixteenth of the distance
  }
}

TEST_CASE("from a tower at sea the horizon dips", "[visibility][curvature]") {
  const double refraction = GENERATE(0.0, 0.13);
  const int off_middle = GENERATE(0, 50);
  constexpr double kTower = 50;
  constexpr int kSide = 301;
  constexpr double kTexel = 400;
  const int row = kSide / 2 - off_middle;
  const int column = kSide / 2 + off_middle;
  const Surface surface = sea_with_peak(kSide, kSide, kTexel, row, column, kTower, refraction);
  const double dip = std::sqrt(2 * kTower * (1 - refraction) / kRadius);
  // The textbook has 1.93' √h of the geometrical dip, and 1.76' to 1.8' with refraction.
  CHECK(dip * 180 / std::numbers::pi * 60 / std::sqrt(kTower) ==
        Approx(1.926 * std::sqrt(1 - refraction)).margin(1e-3));
  const ExactWalker walker(surface, 24);
  for (int k = 0; k < walker.azimuths(); ++k) {
    const Eigen::Vector2d azimuth(std::cos(walker.azimuth_rad(k)), std::sin(walker.azimuth_rad(k)));
    const double slope =
        walker.horizon_slope(row, column, azimuth) - walker.level_slope(row, column, azimuth);
    CHECK(std::atan(slope) == Approx(-dip).margin(1e-6));  // discretisation: texels of a curved sea
  }
  Request request;
  request.wanted.definitions = {SkyDefinition::openness_positive};
  const Results results = solve(surface, request);
  CHECK(double{results.definitions[0](row, column)} ==
        Approx(std::numbers::pi / 2 + dip).margin(2e-4));  // of blocks
}

// Far from the middle of a huge map what is level is tilted against the map's axes by 2 κ r, here 0.13.
TEST_CASE("below the horizontal is what is below it at the place", "[visibility][curvature][below]") {
  const auto [visibility, tolerance] = GENERATE(table<Visibility, double>({
      {Visibility::exact_slices, 1e-5},   // identity: normals are floats
      {Visibility::horizon_walks, 1e-5},  // identity
      {Visibility::rays, 4e-3},           // Monte Carlo
  }));
  const Surface surface = sea_with_peak(41, 41, 50000, 0, 0, 0, 0.13);
  Request request;
  request.wanted = {.sky = true, .below = BelowHorizontal::ground};
  request.accuracy = {.visibility = visibility, .rays = 16384};
  const Results results = solve(surface, request);
  for (const auto& [row, column] : {std::pair{20, 20}, {5, 20}, {20, 35}, {38, 3}}) {
    INFO(row << ", " << column << ", method " << static_cast<int>(visibility));
    CHECK(double{results.sky_view_factor(row, column)} == Approx(1).margin(tolerance));
  }
}

TEST_CASE("heights keep their base when they are curved", "[heightmap][curvature]") {
  Heightmap map = make_map(201, 101, Boundary::open, [](int, int) { return 0.0; });
  map.spacing = {500, 500};
  map.base = 120;
  const Heightmap curved = curve_heights(map);
  const double lowest = kappa(kUsualRefraction) * (50e3 * 50e3 + 25e3 * 25e3);
  CHECK(curved.base == Approx(120 - lowest).margin(1e-9));
  CHECK(curved.height(0, 0) == 0);
  CHECK(double{curved.height(50, 100)} == Approx(lowest).epsilon(1e-6));
  const Gradient level = level_gradient(curved, 0, 200);
  CHECK(level.x == Approx(-2 * kappa(kUsualRefraction) * 50e3));
  CHECK(level.y == Approx(-2 * kappa(kUsualRefraction) * 25e3));
}

TEST_CASE("curvature wants an open map, once, and a refraction below 1", "[heightmap][curvature]") {
  const Heightmap open = make_map(4, 4, Boundary::open, [](int i, int) { return 1.0 * i; });
  const Heightmap tiling = make_map(4, 4, Boundary::tile, [](int i, int) { return 1.0 * i; });
  CHECK_THROWS_AS(curve_heights(tiling), UsageError);
  CHECK_THROWS_AS(curve_heights(curve_heights(open)), UsageError);
  for (const double refraction : {-0.1, 1.0, std::nan("")})
    CHECK_THROWS_AS(curve_heights(open, refraction), UsageError);
}

}  // namespace
}  // namespace heightlight
