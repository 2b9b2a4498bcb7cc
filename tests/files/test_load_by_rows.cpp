#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "files/image_file.h"
#include "files/load_by_rows.h"
#include "heightlight/synth.h"
#include "remedy.h"
#include "scratch_folder.h"
#include "write_samples.h"

using namespace heightlight;

namespace {

/// Loads both ways, and compares all that counts.
void check_alike(const std::filesystem::path& path, const LoadOptions& options) {
  const LoadedHeightmap whole = load_heightmap(path, options, ~0ULL);
  Map heights(whole.map.height.width, whole.map.height.height);
  int next = 0;
  const LoadedHeightmap by_rows =
      load_heightmap_by_rows(path, options, [&](const Heightmap& map, int first, const Map& rows) {
        CHECK(map.height.width == heights.width);
        CHECK(map.height.height == heights.height);
        CHECK(first == next);
        next += rows.height;
        std::memcpy(&heights(first, 0), rows.values.data(), rows.size() * sizeof(float));
      });
  CHECK(next == heights.height);
  CHECK(std::memcmp(heights.values.data(), whole.map.height.values.data(), heights.size() * sizeof(float)) ==
        0);
  CHECK(by_rows.map.base == whole.map.base);
  CHECK(by_rows.map.spacing.x == whole.map.spacing.x);
  CHECK(by_rows.map.spacing.y == whole.map.spacing.y);
  CHECK((by_rows.map.boundary == whole.map.boundary));
  CHECK(by_rows.map.curvature == whole.map.curvature);
  CHECK(by_rows.facts.sha256 == whole.facts.sha256);
  CHECK(by_rows.facts.lowest == whole.facts.lowest);
  CHECK(by_rows.facts.highest == whole.facts.highest);
  CHECK(by_rows.place.has_value() == whole.place.has_value());
}

}  // namespace

TEST_CASE("A TIFF read by rows gives the heights of one read whole", "[files]") {
  const ScratchFolder folder;
  Map heights = synthesize("fbm", 300, 2);
  for (float& height : heights.values) height = 1000 * height - 120;
  SECTION("floats in tiles, with no-data and holes") {
    heights(7, 9) = -9999;
    heights(290, 299) = std::nanf("");
    write_texture(folder / "map.tif",
                  {.width = 300, .height = 300, .channels = {"Y"}, .type = SampleType::real},
                  [&](int first, int count, float* samples) {
                    std::copy_n(&heights(first, 0), count * heights.width, samples);
                  });
    check_alike(folder / "map.tif", {.no_data = -9999});
    check_alike(folder / "map.tif", {.relief = 0.2, .invert = true});
    check_alike(folder / "map.tif",
                {.texel = Spacing{90, 60}, .boundary = Boundary::open, .no_data = -9999, .curvature = 0.13});
    check_alike(folder / "map.tif", {.scale = 0.1, .offset = 3});
  }
  SECTION("levels") {
    write_texture(
        folder / "map.tif", {.width = 300, .height = 300, .channels = {"Y"}, .type = SampleType::uint16},
        [&](int first, int count, float* samples) {
          for (int i = 0; i < count * 300; ++i)
            samples[i] = std::floor(heights.values[static_cast<std::size_t>(first * 300 + i)] + 200);
        });
    check_alike(folder / "map.tif", {});
  }
}

TEST_CASE("By rows, a map of several channels wants one to be chosen, and none can be shrunk", "[files]") {
  const ScratchFolder folder;
  write_texture(folder / "map.tif",
                {.width = 8, .height = 8, .channels = {"R", "G", "B"}, .type = SampleType::real},
                [](int, int count, float* samples) {
                  for (int i = 0; i < count * 24; ++i) samples[i] = static_cast<float>(i);
                });
  const auto ignore = [](const Heightmap&, int, const Map&) {};
  CHECK_THROWS_AS(load_heightmap_by_rows(folder / "map.tif", {}, ignore), Error);
  CHECK_THROWS_AS(load_heightmap_by_rows(folder / "map.tif", {.channel = "G", .shrink = 2}, ignore),
                  UsageError);
  check_alike(folder / "map.tif", {.channel = "G"});
}
