#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "files/image_file.h"
#include "heightlight/error.h"
#include "heightlight/files.h"
#include "remedy.h"
#include "scratch_folder.h"
#include "write_samples.h"

using namespace heightlight;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kLoadMemory = 1 << 30;
const float kNan = std::numeric_limits<float>::quiet_NaN();

LoadedHeightmap load(const fs::path& path, const LoadOptions& options = {}) {
  return load_heightmap(path, options, kLoadMemory);
}

fs::path write_levels(const ScratchFolder& scratch, int width, int height,
                      std::vector<std::uint16_t> levels) {
  Image<std::uint16_t> image(width, height);
  image.values = std::move(levels);
  write_png16(scratch / "levels.png", image);
  return scratch / "levels.png";
}

}  // namespace

TEST_CASE("Integer samples are stretched from 0 to a tenth of the width", "[files]") {
  const ScratchFolder scratch;
  const LoadedHeightmap loaded = load(write_levels(scratch, 2, 2, {100, 200, 300, 500}));
  CHECK(loaded.map.height.values == std::vector<float>{0, 0.025f, 0.05f, 0.1f});
  CHECK(loaded.map.base == 0);
  CHECK(loaded.map.spacing.x == 0.5);
  CHECK(loaded.map.spacing.y == 0.5);
  CHECK(loaded.map.boundary == Boundary::tile);
  CHECK(loaded.facts.format == "png");
  CHECK(loaded.facts.sample_type == "uint16");
  CHECK(loaded.facts.bits == 16);
  CHECK(loaded.facts.is_integer);
  CHECK(loaded.facts.levels == 4);
  CHECK(loaded.facts.lowest == 100);
  CHECK(loaded.facts.highest == 500);
  CHECK(loaded.facts.sha256.size() == 64);
}

TEST_CASE("The default relief follows the width, whichever option gives it", "[files]") {
  const ScratchFolder scratch;
  const fs::path path = write_levels(scratch, 4, 1, {0, 1, 2, 3});
  LoadOptions options;
  options.width = 8;
  CHECK(relief(load(path, options).map) == Approx(0.8));
  CHECK(load(path, options).map.spacing.y == 2);
  options = {};
  options.texel = Spacing{3, 5};
  const LoadedHeightmap loaded = load(path, options);
  CHECK(relief(loaded.map) == Approx(1.2));
  CHECK(loaded.map.spacing.x == 3);
  CHECK(loaded.map.spacing.y == 5);
  options.relief = 7;
  CHECK(relief(load(path, options).map) == 7);
}

TEST_CASE("Float samples are heights above their lowest, stretched only on demand", "[files]") {
  const ScratchFolder scratch;
  const fs::path path = write_samples(scratch / "map.exr", 3, 1, {"Y"}, std::vector<float>{-2, 0, 6});
  const LoadedHeightmap loaded = load(path);
  CHECK(loaded.map.height.values == std::vector<float>{0, 2, 8});
  CHECK(loaded.map.base == -2);
  CHECK_FALSE(loaded.facts.is_integer);
  LoadOptions options;
  options.relief = 2;
  CHECK(load(path, options).map.height.values == std::vector<float>{0, 0.5f, 2});
  CHECK(load(path, options).map.base == 0);
}

TEST_CASE("Inverting turns the highest sample into the lowest place", "[files]") {
  const ScratchFolder scratch;
  LoadOptions options;
  options.invert = true;
  CHECK(load(write_levels(scratch, 3, 1, {10, 20, 30}), options).map.height.values ==
        std::vector<float>{0.1f, 0.05f, 0});
  const LoadedHeightmap depths =
      load(write_samples(scratch / "depth.exr", 3, 1, {"Y"}, std::vector<float>{1, 2, 5}), options);
  CHECK(depths.map.height.values == std::vector<float>{4, 3, 0});
  CHECK(depths.map.base == -5);  // the depth 5 is the height −5
}

TEST_CASE("Small relief on a large offset keeps its digits", "[files]") {
  const ScratchFolder scratch;
  const fs::path path = write_text(scratch / "grid.asc",
                                   "ncols 3\nnrows 1\ncellsize 1\n1000000.0001 1000000.00037 1000000.001\n");
  const Heightmap map = load(path).map;
  // Discretisation: the text's doubles have steps of 1.2e-10 there; single precision at 1e6 would have steps
  // of 0.06.
  CHECK(map.height.values[1] == Approx(0.00027).margin(2e-10));
  CHECK(map.height.values[2] == Approx(0.0009).margin(2e-10));
  CHECK(map.base == 1000000.0001);
}

TEST_CASE("A grid brings its own spacing and stands alone, and its rows keep their proportion under --width",
          "[files]") {
  const ScratchFolder scratch;
  const fs::path path = write_text(scratch / "grid.asc", "ncols 2\nnrows 3\ndx 10\ndy 20\n1 2\n3 4\n5 6\n");
  const LoadedHeightmap loaded = load(path);
  CHECK(loaded.map.height == [] {
    Image<float> expected(2, 3);
    expected.values = {0, 1, 2, 3, 4, 5};
    return expected;
  }());
  CHECK(loaded.map.spacing.x == 10);
  CHECK(loaded.map.spacing.y == 20);
  CHECK(loaded.map.boundary == Boundary::open);
  CHECK(loaded.facts.format == "esri ascii grid");
  CHECK(loaded.facts.sample_type == "text");
  CHECK(loaded.facts.bits == 0);
  LoadOptions options;
  options.width = 4;
  CHECK(load(path, options).map.spacing.x == 2);
  CHECK(load(path, options).map.spacing.y == 4);
  options = {};
  options.boundary = Boundary::tile;
  CHECK(load(path, options).map.boundary == Boundary::tile);
}

TEST_CASE("No-data goes missing whether the header, the user or NaN says so", "[files]") {
  const ScratchFolder scratch;
  const std::string size = "ncols 4\nnrows 1\ncellsize 1\n";
  const std::string values = "-9999 5 -1 7\n";
  LoadOptions options;
  const Heightmap declared = load(write_text(scratch / "a.asc", size + "NODATA_value -9999\n" + values)).map;
  CHECK(count_missing(declared) == 1);
  CHECK(std::isnan(declared.height.values[0]));
  CHECK(declared.base == -1);

  const fs::path undeclared = write_text(scratch / "b.asc", size + "-8888 5 -1 7\n");
  CHECK(count_missing(load(undeclared).map) == 0);
  options.no_data = -8888;
  CHECK(count_missing(load(undeclared, options).map) == 1);

  options.no_data = -1;
  CHECK(count_missing(load(scratch / "a.asc", options).map) == 2);
  CHECK(load(scratch / "a.asc", options).facts.declared_no_data == -9999);
}

TEST_CASE("NaN and infinities of a float file are missing", "[files]") {
  const ScratchFolder scratch;
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<float> samples{1, kNan, infinity, -infinity, 3};
  const LoadedHeightmap loaded = load(write_samples(scratch / "map.tif", 5, 1, {"Y"}, samples));
  CHECK(count_missing(loaded.map) == 3);
  CHECK(loaded.facts.levels == 2);
  CHECK(loaded.facts.highest == 3);
  CHECK(relief(loaded.map) == 2);
}

TEST_CASE("A no-data value in decimals means the nearest float", "[files]") {
  const ScratchFolder scratch;
  const fs::path path = write_samples(scratch / "map.tif", 3, 1, {"Y"}, std::vector<float>{-0.1f, 1, 2});
  LoadOptions options;
  options.no_data = -0.1;
  CHECK(count_missing(load(path, options).map) == 1);
}

TEST_CASE("A map of nothing but missing samples is refused", "[files]") {
  const ScratchFolder scratch;
  const fs::path path = write_samples(scratch / "nothing.exr", 2, 1, {"Y"}, std::vector<float>{kNan, kNan});
  CHECK_THROWS_WITH(load(path), Contains("nothing.exr") && Contains("missing"));
}

TEST_CASE("A level map stays level, with a relief or without", "[files]") {
  const ScratchFolder scratch;
  const fs::path path = write_levels(scratch, 2, 2, {7, 7, 7, 7});
  LoadOptions options;
  options.relief = 3;
  CHECK(relief(load(path).map) == 0);
  CHECK(relief(load(path, options).map) == 0);
  CHECK(load(path).facts.levels == 1);
}

TEST_CASE("One column or one row is a map", "[files]") {
  const ScratchFolder scratch;
  CHECK(load(write_levels(scratch, 1, 3, {0, 1, 2})).map.height.height == 3);
  CHECK(load(write_levels(scratch, 3, 1, {0, 1, 2})).map.height.width == 3);
  CHECK(load(write_levels(scratch, 1, 1, {5})).map.height.size() == 1);
}

TEST_CASE("Options outside their range are wrong usage", "[files]") {
  const ScratchFolder scratch;
  const fs::path path = write_levels(scratch, 2, 1, {0, 1});
  const auto refuse = [&](const LoadOptions& options, const std::string& name) {
    CHECK_THROWS_AS(load(path, options), UsageError);
    CHECK_THROWS_WITH(load(path, options), Contains(name));
  };
  for (const double bad : {0.0, -1.0, static_cast<double>(kNan), std::numeric_limits<double>::infinity()}) {
    LoadOptions options;
    options.relief = bad;
    refuse(options, "relief");
    options = {};
    options.width = bad;
    refuse(options, "width");
    options = {};
    options.texel = Spacing{1, bad};
    refuse(options, "texel");
  }
  LoadOptions both;
  both.width = 1;
  both.texel = Spacing{1, 1};
  refuse(both, "width: excludes a texel");
}

TEST_CASE("Heights that single precision cannot hold are refused", "[files]") {
  const ScratchFolder scratch;
  const fs::path path = write_samples(scratch / "vast.tif", 1, 2, {"Y"}, std::vector<double>{-1e300, 1e300});
  CHECK_THROWS_WITH(load(path), Contains("vast.tif") && Contains("single precision"));
}

TEST_CASE("The memory limit holds for a whole load", "[files]") {
  const ScratchFolder scratch;
  const fs::path path = write_levels(scratch, 100, 100, std::vector<std::uint16_t>(10'000, 1));
  CHECK_THROWS_WITH(load_heightmap(path, {}, 50'000), Contains("levels.png"));
  CHECK_THAT(remedy_of([&] { load_heightmap(path, {}, 50'000); }), Catch::StartsWith("memory"));
}
