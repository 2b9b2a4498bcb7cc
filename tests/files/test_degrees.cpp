#include <catch2/catch.hpp>

#include "files/degrees.h"
#include "heightlight/heightmap.h"
#include "scratch_folder.h"

using namespace heightlight;
using Catch::Contains;

namespace {

/// Of a grid with 120 columns and 100 rows.
Georeference grid_at(double west, double south, double cell) {
  return {.corner = {{west, south + 100 * cell}}, .cell = {cell, cell}};
}

bool looks_like_degrees(const Georeference& place, double relief) {
  return heightlight::looks_like_degrees(place, 120, 100, relief);
}

}  // namespace

TEST_CASE("A cell size in degrees is told from lengths by place, size and steepness", "[files]") {
  CHECK(looks_like_degrees(grid_at(-105.55, 40.09, 1.0 / 1200), 1343));
  CHECK(looks_like_degrees(grid_at(-180, -90, 0.01), 8000));
  CHECK_FALSE(looks_like_degrees(grid_at(500000, 4500000, 0.25), 30));  // a town in UTM, off the globe
  CHECK_FALSE(looks_like_degrees(grid_at(10, 20, 1), 1343));            // cells of a metre
  CHECK_FALSE(looks_like_degrees(grid_at(0, 0, 0.01), 1343));  // a corner at the bare origin says nothing
  CHECK_FALSE(
      looks_like_degrees(grid_at(10, 20, 0.01), 0.3));  // relief that fits the extent: a scanned relief
  CHECK_FALSE(looks_like_degrees({.cell = {0.01, 0.01}}, 1343));
}

TEST_CASE("A degree is as long as on the WGS 84 ellipsoid", "[files]") {
  // NGA's table of the length of a degree: latitude, metres to the north, metres to the east.
  const auto [latitude, north, east] = GENERATE(
      table<double, double, double>({{0, 110574, 111320}, {45, 111132, 78847}, {60, 111412, 55800}}));
  const Spacing metres = degrees_in_metres({1, 1}, latitude);
  CHECK(metres.x == Approx(east).margin(1));  // the table is rounded to metres
  CHECK(metres.y == Approx(north).margin(1));
}

TEST_CASE("A grid in degrees is measured in metres, and a user is told", "[files]") {
  const ScratchFolder scratch;
  const auto path =
      write_text(scratch / "dem.asc",
                 "ncols 2\nnrows 2\nxllcorner -105.5\nyllcorner 40\ncellsize 0.001\n100 200\n300 400\n");
  const LoadedHeightmap loaded = load_heightmap(path, {}, 1 << 30);
  CHECK(loaded.map.spacing.x == Approx(85.39).margin(0.005));  // at 40.001° north
  CHECK(loaded.map.spacing.y == Approx(111.03).margin(0.005));
  CHECK(loaded.map.boundary == Boundary::open);
  CHECK_THAT(loaded.warnings.back().message, Contains("0.001 x 0.001 degrees are 85.39 x 111 m"));
  const LoadedHeightmap given = load_heightmap(path, {.texel = Spacing{85, 110}}, 1 << 30);
  CHECK(given.map.spacing.y == 110);
  CHECK(given.warnings.size() + 1 == loaded.warnings.size());
}
