#include <catch2/catch.hpp>

#include "heightlight/error.h"
#include "heightlight/files.h"
#include "remedy.h"
#include "scratch_folder.h"
#include "write_samples.h"

using namespace heightlight;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

LoadedHeightmap load_channel(const fs::path& path, const std::optional<std::string>& channel = std::nullopt) {
  LoadOptions options;
  options.channel = channel;
  return load_heightmap(path, options, 1 << 30);
}

const std::vector<std::string> kRgb{"R", "G", "B"};
const std::vector<std::string> kRgba{"R", "G", "B", "A"};

}  // namespace

TEST_CASE("Grey stored as RGB is one channel beside alpha", "[files]") {
  const ScratchFolder scratch;
  const LoadedHeightmap rgb = load_channel(
      write_samples(scratch / "rgb.png", 2, 1, kRgb, std::vector<std::uint8_t>{1, 1, 1, 9, 9, 9}));
  CHECK(rgb.facts.channel == "grey (R = G = B)");
  CHECK(rgb.facts.channels == 3);
  CHECK(rgb.facts.highest == 9);
  const LoadedHeightmap rgba = load_channel(
      write_samples(scratch / "rgba.png", 2, 1, kRgba, std::vector<std::uint8_t>{1, 1, 1, 0, 9, 9, 9, 200}));
  CHECK(rgba.facts.channel == "grey (R = G = B)");
  CHECK(rgba.facts.lowest == 9);  // the other is transparent
  const LoadedHeightmap grey = load_channel(
      write_samples(scratch / "ya.png", 2, 1, {"Y", "A"}, std::vector<std::uint8_t>{1, 50, 9, 200}));
  CHECK(grey.facts.channel == "Y");
  CHECK(grey.facts.highest == 9);
}

TEST_CASE("Channels that are missing in the same places agree", "[files]") {
  const ScratchFolder scratch;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const fs::path path =
      write_samples(scratch / "a.exr", 2, 1, kRgb, std::vector<float>{1, 1, 1, nan, nan, nan});
  CHECK(count_missing(load_channel(path).map) == 1);
}

TEST_CASE("Channels that differ are refused until one is chosen, by name or number", "[files]") {
  const ScratchFolder scratch;
  const std::vector<std::uint8_t> samples{1, 2, 3, 9, 4, 5};
  const fs::path path = write_samples(scratch / "colour.png", 2, 1, kRgb, samples);
  CHECK_THROWS_WITH(load_channel(path), Contains("colour.png") && Contains("R, G, B"));
  CHECK(remedy_of([&] { load_channel(path); }) == "channel");
  CHECK(load_channel(path, "g").facts.highest == 4);
  CHECK(load_channel(path, "G").facts.channel == "G");
  CHECK(load_channel(path, "2").facts.highest == 5);
  CHECK(load_channel(path, "0").facts.channel == "R");
}

TEST_CASE("A channel that the file lacks is wrong usage, and those it has are listed", "[files]") {
  const ScratchFolder scratch;
  const fs::path path = write_samples(scratch / "grey.png", 2, 1, {"Y"}, std::vector<std::uint8_t>{1, 2});
  for (const char* wanted : {"Z", "1", "-1", "", "0x0"}) {
    CHECK_THROWS_AS(load_channel(path, wanted), UsageError);
    CHECK_THROWS_WITH(load_channel(path, wanted), Contains("grey.png") && Contains("it has Y"));
  }
}

TEST_CASE("An EXR's channel is found by its layer's name", "[files]") {
  const ScratchFolder scratch;
  const fs::path path =
      write_samples(scratch / "layers.exr", 2, 1, {"Y", "depth.Z"}, std::vector<float>{1, 5, 2, 8});
  CHECK_THROWS_WITH(load_channel(path), Contains("Y, depth.Z"));
  CHECK(load_channel(path, "Depth.z").facts.lowest == 5);
}
