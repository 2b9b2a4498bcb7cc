#include <catch2/catch.hpp>
#include <limits>

#include "heightlight/error.h"
#include "heightlight/files.h"
#include "scratch_folder.h"
#include "write_samples.h"

using namespace heightlight;
using Catch::Contains;

namespace {

constexpr std::uint64_t kSkyMemory = 1 << 28;

}  // namespace

TEST_CASE("A sky is read from EXR and HDR", "[files]") {
  const ScratchFolder scratch;
  const std::vector<float> samples{1, 2, 4, 0, 0.5F, 8};
  const auto path = GENERATE("sky.exr", "sky.hdr");
  write_samples(scratch / path, 2, 1, {"R", "G", "B"}, samples);
  const SkyLight sky = load_sky_light(scratch / path, kSkyMemory);
  CHECK(sky.radiance.values == std::vector<Vector3>{{1, 2, 4}, {0, 0.5F, 8}});
}

TEST_CASE("Channels of a sky are found by name, and grey is taken for all", "[files]") {
  const ScratchFolder scratch;
  write_samples<float>(scratch / "four.exr", 2, 1, {"R", "G", "B", "A"}, {1, 2, 3, 1, 4, 5, 6, 1});
  CHECK(load_sky_light(scratch / "four.exr", kSkyMemory).radiance.values ==
        std::vector<Vector3>{{1, 2, 3}, {4, 5, 6}});
  write_samples<float>(scratch / "grey.exr", 2, 1, {"Y"}, {3, 4});
  CHECK(load_sky_light(scratch / "grey.exr", kSkyMemory).radiance.values ==
        std::vector<Vector3>{{3, 3, 3}, {4, 4, 4}});
}

TEST_CASE("What is no sky is refused with its file and the reason", "[files]") {
  const ScratchFolder scratch;
  const auto fault = [&](const std::filesystem::path& path) -> std::string {
    try {
      load_sky_light(path, kSkyMemory);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  write_samples<std::uint8_t>(scratch / "levels.png", 2, 1, {"R", "G", "B"}, {1, 2, 3, 4, 5, 6});
  CHECK_THAT(fault(scratch / "levels.png"), Contains("levels.png: a sky wants radiance"));
  write_samples<float>(scratch / "square.exr", 1, 1, {"R", "G", "B"}, {1, 2, 3});
  CHECK_THAT(fault(scratch / "square.exr"), Contains("square.exr: a sky of latitude by longitude"));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  write_samples<float>(scratch / "nan.exr", 2, 1, {"R", "G", "B"}, {1, 2, 3, 4, nan, 6});
  CHECK_THAT(fault(scratch / "nan.exr"), Contains("nan.exr: a sky's radiance must be finite"));
  write_samples<float>(scratch / "xyz.exr", 2, 1, {"X", "Y", "Z"}, {1, 2, 3, 4, 5, 6});
  CHECK_THAT(fault(scratch / "xyz.exr"), Contains("xyz.exr: has no channels R, G and B, but X, Y, Z"));
  CHECK_THAT(fault(scratch / "absent.exr"), Contains("absent.exr: no such file"));
}
