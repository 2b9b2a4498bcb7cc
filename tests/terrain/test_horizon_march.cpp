#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "heightlight/files.h"
#include "shared_data.h"
#include "terrain/horizon_march.h"
#include "terrain/marched_quantities.h"
#include "terrain/terrain_truth.h"
#include "test_maps.h"

// The usual algorithm for horizons, as terrain tools have it: by hand, and against maps that they made.

namespace heightlight {
namespace {

using std::numbers::pi;

constexpr double kNothing = -std::numeric_limits<double>::infinity();

LoadOptions terrain_options(double texel) {
  LoadOptions options;
  options.texel = Spacing{texel, texel};
  options.boundary = Boundary::open;
  return options;
}

LoadedHeightmap load_shared(const std::filesystem::path& path, double texel) {
  return load_heightmap(path, terrain_options(texel), std::uint64_t{1} << 30);
}

/// RMS of found − reference over all texels that are so many from the border.
double rms_inside(const Image<double>& found, const Heightmap& reference, int border) {
  double squares = 0;
  double count = 0;
  for (int row = border; row < found.height - border; ++row) {
    for (int column = border; column < found.width - border; ++column) {
      const double difference = found(row, column) - (double{reference.height(row, column)} + reference.base);
      if (std::isnan(difference)) continue;
      squares += difference * difference;
      count += 1;
    }
  }
  return std::sqrt(squares / count);
}

/// Dozier and Frew's sky view factor, eq. 7b: H is the horizon's angle from the zenith, and the slope's
/// tangent plane hides nothing.
Image<double> dozier_sky(const Surface& surface, int azimuths, CellDistance distance) {
  Image<double> sky(surface.width(), surface.height());
  for (int k = 0; k < azimuths; ++k) {
    const double azimuth = pi / 2 - 2 * pi * k / azimuths;
    const Map slopes = march_horizon(surface, {.azimuth_rad = azimuth, .distance = distance});
    for (std::size_t i = 0; i < sky.size(); ++i) {
      const Vector3& normal = surface.normal.values[i];
      const double along = double{normal.x} * std::cos(azimuth) + double{normal.y} * std::sin(azimuth);
      const double zenith = pi / 2 - std::atan(std::max(0.0, double{slopes.values[i]}));
      const double sine = std::sin(zenith);
      sky.values[i] +=
          (double{normal.z} * sine * sine + along * (zenith - sine * std::cos(zenith))) / azimuths;
    }
  }
  return sky;
}

TEST_CASE("a march finds the steepest of the nearest cells", "[terrain]") {
  // A post of height 6 on level ground, and a hole beside it.
  Heightmap map = make_map(9, 9, Boundary::open, [](int row, int column) {
    if (row == 3 && column == 5) return std::nan("");
    return row == 4 && column == 6 ? 6.0 : 0.0;
  });
  map.spacing = {2, 2};
  const Surface surface = build_surface(map);
  const auto slope = [&](const MarchOptions& options, int row, int column) {
    return double{march_horizon(surface, options)(row, column)};
  };
  CHECK(slope({.azimuth_rad = 0}, 4, 2) == Approx(6.0 / 8));
  CHECK(slope({.azimuth_rad = 0}, 4, 7) == 0);
  CHECK(slope({.azimuth_rad = 0}, 4, 8) == kNothing);  // the first step leaves the map
  CHECK(slope({.azimuth_rad = pi}, 4, 8) == Approx(6.0 / 4));
  CHECK(slope({.azimuth_rad = 0, .cells = 4}, 4, 2) == Approx(6.0 / 8));
  CHECK(slope({.azimuth_rad = 0, .cells = 3}, 4, 2) == 0);
  CHECK(std::isnan(slope({.azimuth_rad = 1}, 3, 5)));
  CHECK(slope({.azimuth_rad = 0}, 3, 4) == 0);  // a hole hides nothing
  // Up the map, to the right: the first step of one cell ends 0.3 short of the diagonal neighbour's middle.
  const double up_right = pi / 4;
  CHECK(slope({.azimuth_rad = up_right}, 5, 5) == Approx(6.0 / 2));
  CHECK(slope({.azimuth_rad = up_right, .distance = CellDistance::to_cell}, 5, 5) ==
        Approx(6.0 / (2 * std::numbers::sqrt2)));
}

TEST_CASE("a march steps by the shorter side of a cell", "[terrain]") {
  Heightmap map = make_map(4, 9, Boundary::open, [](int row, int) { return row == 0 ? 3.0 : 0.0; });
  map.spacing = {1, 3};
  const Surface surface = build_surface(map);
  CHECK(march_horizon(surface, {.azimuth_rad = pi / 2, .distance = CellDistance::to_cell})(4, 1) ==
        Approx(3.0 / 12));
  CHECK(march_horizon(surface, {.azimuth_rad = pi / 2, .cells = 10})(4, 1) == 0);
  CHECK(march_horizon(surface, {.azimuth_rad = pi / 2, .cells = 12})(4, 1) > 0.2);
}

/// A map of cells of 1 by 1.
template <class Function>
Surface unit_cells(int side, Function&& height_at) {
  Heightmap map = make_map(side, side, Boundary::open, height_at);
  map.spacing = {1, 1};
  return build_surface(std::move(map));
}

/// What marches find at the middle of a map.
double marched(const Surface& surface, const TerrainQuantity& quantity) {
  const Map map = march_quantities(surface, 64, {}, {quantity})[0].map;
  return double{map(surface.height() / 2, surface.width() / 2)};
}

TEST_CASE("marched quantities of a level receiver amid a round wall are what their formulas say",
          "[terrain]") {
  // The wall stands from a distance of 10 on; its inner rim of cells hides all that is beyond.
  const double wall = 6;
  const Surface surface = unit_cells(
      41, [&](int row, int column) { return std::hypot(row - 20, column - 20) > 9.5 ? wall : 0.0; });
  const double h = std::atan(wall / 10);
  const double margin = 0.02;  // discretisation: the rim is not round
  CHECK(marched(surface, {SkyDefinition::svf_tilted, BelowHorizontal::sky}) ==
        Approx(std::pow(std::cos(h), 2)).margin(margin));
  CHECK(marched(surface, {SkyDefinition::svf_tilted, BelowHorizontal::ground}) ==
        Approx(std::pow(std::cos(h), 2)).margin(margin));
  CHECK(marched(surface, {.definition = SkyDefinition::svf_horizontal}) ==
        Approx(std::pow(std::cos(h), 2)).margin(margin));
  CHECK(marched(surface, {.definition = SkyDefinition::svf_solid_angle}) ==
        Approx(1 - std::sin(h)).margin(margin));
  CHECK(marched(surface, {.definition = SkyDefinition::mean_cos_h}) == Approx(std::cos(h)).margin(margin));
  CHECK(marched(surface, {.definition = SkyDefinition::openness_positive}) ==
        Approx(pi / 2 - h).margin(margin));
}

TEST_CASE("of an open slope the tangent plane hides nothing, the horizontal its lower part", "[terrain]") {
  const Surface slope = unit_cells(15, [](int row, int column) { return 0.5 * column + 0.2 * row; });
  const double cosine = double{slope.normal(7, 7).z};
  REQUIRE(cosine < 0.9);
  const TerrainQuantity below_sky{SkyDefinition::svf_tilted, BelowHorizontal::sky};
  const TerrainQuantity below_ground{SkyDefinition::svf_tilted, BelowHorizontal::ground};
  // Discretisation: the nearest cell may lie higher than the ray, which costs sky; and azimuths.
  CHECK(marched(slope, below_sky) == Approx(1).margin(0.02));
  CHECK(marched(slope, below_ground) == Approx((1 + cosine) / 2).margin(0.02));
  const std::vector<double> exact = find_exactly(slope, 128, {7 * 15 + 7}, below_ground);
  CHECK(exact[0] == Approx((1 + cosine) / 2).margin(1e-4));  // discretisation: azimuths
  CHECK(find_exactly(slope, 128, {7 * 15 + 7}, below_sky)[0] == Approx(1).margin(1e-6));
}

TEST_CASE("with 16 azimuths, and ways along the ray, a march is that of SAGA GIS", "[terrain]") {
  const auto dem = find_shared_data("terrain/lakes_dem.tif");
  const auto theirs = find_shared_data("reference/lakes_svf_saga_tilted.tif");
  if (!dem || !theirs) return;
  const Surface surface = build_surface(load_shared(*dem, 50).map);
  const Heightmap reference = load_shared(*theirs, 50).map;
  // Golden; their map is of steps that end elsewhere by rounding.
  CHECK(rms_inside(dozier_sky(surface, 16, CellDistance::along_ray), reference, 2) < 3e-4);
  CHECK(rms_inside(dozier_sky(surface, 16, CellDistance::to_cell), reference, 2) > 2e-3);
}

TEST_CASE("with distances of cells a march comes near that of rastertools", "[terrain]") {
  const auto dem = find_shared_data("terrain/toulouse-mnh.tif");
  const auto theirs = find_shared_data("reference/toulouse_mean_cos_h_16az_50px.tif");
  if (!dem || !theirs) return;
  const Surface surface = build_surface(load_shared(*dem, 0.5).map);
  const Heightmap reference = load_shared(*theirs, 0.5).map;
  const auto rms = [&](CellDistance distance) {
    const auto found = march_quantities(surface, 16, {.cells = 50, .distance = distance},
                                        {{.definition = SkyDefinition::mean_cos_h}});
    Image<double> values(surface.width(), surface.height());
    for (std::size_t i = 0; i < values.size(); ++i) values.values[i] = double{found[0].map.values[i]};
    return rms_inside(values, reference, 52);
  };
  CHECK(rms(CellDistance::to_cell) < 2.5e-3);  // golden
  CHECK(rms(CellDistance::along_ray) > 5e-3);
}

TEST_CASE("a march is the same for any number of threads", "[terrain]") {
  const Surface surface = build_surface(make_rough_map(40, 30, Boundary::open, 0.1, 0, 3));
  const auto with_threads = [&](int threads) {
    const ThreadScope scope(threads);
    return march_quantities(surface, 8, {.cells = 20}, terrain_quantities())[1].map;
  };
  CHECK(with_threads(1) == with_threads(3));
}

}  // namespace
}  // namespace heightlight
