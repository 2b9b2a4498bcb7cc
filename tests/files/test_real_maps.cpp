#include <catch2/catch.hpp>

#include "heightlight/error.h"
#include "heightlight/files.h"
#include "remedy.h"
#include "shared_data.h"

using namespace heightlight;
using Catch::Contains;

namespace {

constexpr std::uint64_t kGigabyte = std::uint64_t{1} << 30;

}  // namespace

TEST_CASE("Real material maps load, and tile", "[files][shared]") {
  const auto [name, width, height, bits] =
      GENERATE(table<std::string, int, int, int>({{"material/DiamondPlate008C_height16.png", 1024, 1024, 16},
                                                  {"material/Ground054_height16.png", 1024, 1024, 16},
                                                  {"material/Ground054_height.jpg", 1024, 1024, 8},
                                                  {"material/Leather031_height16.png", 1024, 1024, 16},
                                                  {"material/MetalWalkway006_height16.png", 1024, 1024, 16},
                                                  {"material/Bricks102_height.jpg", 1024, 512, 8},
                                                  {"material/materialx_plain_heightmap.png", 512, 512, 8}}));
  const auto path = find_shared_data(name);
  if (!path) return;
  CAPTURE(name);
  const LoadedHeightmap loaded = load_heightmap(*path, {}, kGigabyte);
  CHECK(loaded.map.height.width == width);
  CHECK(loaded.map.height.height == height);
  CHECK(loaded.facts.bits == bits);
  CHECK(loaded.facts.channel == "Y");
  CHECK(relief(loaded.map) == Approx(0.1));
  CHECK(count_missing(loaded.map) == 0);
  CHECK(measure_edge_steps(loaded.map.height).wraps);
}

TEST_CASE("The 8-bit Ground054 is the 16-bit one in fewer levels", "[files][shared]") {
  const auto coarse = find_shared_data("material/Ground054_height.jpg");
  const auto fine = find_shared_data("material/Ground054_height16.png");
  if (!coarse || !fine) return;
  CHECK(load_heightmap(*coarse, {}, kGigabyte).facts.levels < 256);
  CHECK(load_heightmap(*fine, {}, kGigabyte).facts.levels > 40'000);
}

TEST_CASE("Real terrain loads with its heights and its holes", "[files][shared]") {
  const auto [name, lowest, highest, missing] = GENERATE(
      table<std::string, double, double, std::size_t>({{"terrain/lakes_dem.tif", 2383.85, 3581.19, 0},
                                                       {"terrain/DSM_PHR_Dunkerque.tif", 33.78, 68.92, 1005},
                                                       {"terrain/toulouse-mnh.tif", 0, 33.34, 0}}));
  const auto path = find_shared_data(name);
  if (!path) return;
  CAPTURE(name);
  const LoadedHeightmap loaded = load_heightmap(*path, {}, kGigabyte);
  CHECK(loaded.facts.sample_type == "float");
  CHECK(loaded.map.base == Approx(lowest).margin(0.01));
  CHECK(loaded.map.base + relief(loaded.map) == Approx(highest).margin(0.01));
  CHECK(count_missing(loaded.map) == missing);
  CHECK_FALSE(measure_edge_steps(loaded.map.height).wraps);
}

TEST_CASE("Half of hugo_site is missing once its undeclared no-data value is given", "[files][shared]") {
  const auto path = find_shared_data("terrain/hugo_site_filled.asc");
  if (!path) return;
  LoadOptions options;
  options.no_data = -9999;
  const LoadedHeightmap loaded = load_heightmap(*path, options, kGigabyte);
  CHECK_FALSE(loaded.facts.declared_no_data);
  CHECK(count_missing(loaded.map) == 2028);
  CHECK(loaded.map.height.width == 76);
  CHECK(loaded.map.height.height == 55);
  CHECK(loaded.map.spacing.x == 10);
  CHECK(relief(loaded.map) == 51);
}

TEST_CASE("Boulder's cells in degrees are measured in metres", "[files][shared]") {
  const auto path = find_shared_data("terrain/SRTMGL3_boulder.asc");
  if (!path) return;
  const LoadedHeightmap loaded = load_heightmap(*path, {}, kGigabyte);
  CHECK(loaded.map.spacing.x == Approx(71.01).margin(0.005));
  CHECK(loaded.map.spacing.y == Approx(92.53).margin(0.005));
  CHECK(loaded.map.height.width == 240);
  CHECK(loaded.map.height.height == 144);
  CHECK(relief(loaded.map) == 1343);
  CHECK(count_missing(loaded.map) == 0);
}
