#include <catch2/catch.hpp>

#include "files/degrees.h"
#include "heightlight/heightmap.h"
#include "remedy.h"
#include "scratch_folder.h"

using namespace heightlight;
using Catch::Contains;

namespace {

EsriHeader header(double west, double south, double cell) {
  return {120, 100, cell, cell, west, south, std::nullopt};
}

}  // namespace

TEST_CASE("A cell size in degrees is told from lengths by place, size and steepness", "[files]") {
  CHECK(is_in_degrees(header(-105.55, 40.09, 1.0 / 1200), 1343));
  CHECK(is_in_degrees(header(-180, -90, 0.01), 8000));
  CHECK_FALSE(is_in_degrees(header(500000, 4500000, 0.25), 30));  // a town in UTM, off the globe
  CHECK_FALSE(is_in_degrees(header(10, 20, 1), 1343));            // cells of a metre
  CHECK_FALSE(is_in_degrees(header(0, 0, 0.01), 1343));           // a corner at the bare origin says nothing
  CHECK_FALSE(is_in_degrees(header(10, 20, 0.01), 0.3));  // relief that fits the extent: a scanned relief
  CHECK_FALSE(is_in_degrees({120, 100, 0.01, 0.01, std::nullopt, std::nullopt, std::nullopt}, 1343));
}

TEST_CASE("A degree is as long as on the WGS 84 ellipsoid", "[files]") {
  // NGA's table of the length of a degree: latitude, metres to the north, metres to the east.
  const auto [latitude, north, east] = GENERATE(
      table<double, double, double>({{0, 110574, 111320}, {45, 111132, 78847}, {60, 111412, 55800}}));
  const Spacing metres = cell_in_metres({1, 1, 1, 1, 0, latitude - 0.5, std::nullopt});
  CHECK(metres.x == Approx(east).margin(1));  // the table is rounded to metres
  CHECK(metres.y == Approx(north).margin(1));
}

TEST_CASE("A grid in degrees is refused with the spacing to give, and taken with it", "[files]") {
  const ScratchFolder scratch;
  const auto path =
      write_text(scratch / "dem.asc",
                 "ncols 2\nnrows 2\nxllcorner -105.5\nyllcorner 40\ncellsize 0.001\n100 200\n300 400\n");
  // 0.001° at 40.001° north.
  CHECK_THROWS_WITH(load_heightmap(path, {}, 1 << 30), Contains("dem.asc") && Contains("degrees"));
  CHECK(remedy_of([&] { load_heightmap(path, {}, 1 << 30); }) == "texel 85.39x111");
  LoadOptions options;
  options.texel = Spacing{85.39, 111};
  CHECK(load_heightmap(path, options, 1 << 30).map.spacing.y == 111);
}
