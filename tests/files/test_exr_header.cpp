#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>

#include "files/exr_header.h"
#include "files/image_read.h"
#include "heightlight/error.h"
#include "heightlight/files.h"
#include "remedy.h"
#include "scratch_folder.h"
#include "write_samples.h"

using namespace heightlight;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

/// Two parts, "deep" with 1, 2 and "flat" with 3, 4.
fs::path write_parts(const fs::path& path) {
  std::vector<OIIO::ImageSpec> specs(2, OIIO::ImageSpec(2, 1, 1, OIIO::TypeDesc::FLOAT));
  for (std::size_t i = 0; i < 2; ++i) {
    specs[i].channelnames = {"Y"};
    specs[i].attribute("oiio:subimagename", i == 0 ? "deep" : "flat");
  }
  const auto output = OIIO::ImageOutput::create(path.string());
  REQUIRE(output->open(path.string(), 2, specs.data()));
  const float first[] = {1, 2};
  const float second[] = {3, 4};
  REQUIRE(output->write_image(OIIO::TypeDesc::FLOAT, first));
  REQUIRE(output->open(path.string(), specs[1], OIIO::ImageOutput::AppendSubimage));
  REQUIRE(output->write_image(OIIO::TypeDesc::FLOAT, second));
  REQUIRE(output->close());
  return path;
}

}  // namespace

TEST_CASE("of an EXR of several parts one is chosen by name or number", "[files]") {
  const ScratchFolder scratch;
  const fs::path path = write_parts(scratch / "p.exr");
  CHECK_THROWS_WITH(load_heightmap(path, {}, 1 << 20), Contains("2 parts") && Contains("deep, flat"));
  CHECK(remedy_of([&] { load_heightmap(path, {}, 1 << 20); }) == "part");
  CHECK(load_heightmap(path, {.part = "FLAT"}, 1 << 20).facts.lowest == 3);
  CHECK(load_heightmap(path, {.part = "0"}, 1 << 20).facts.lowest == 1);
  CHECK_THROWS_AS(load_heightmap(path, {.part = "round"}, 1 << 20), UsageError);
  const fs::path other = write_samples(scratch / "a.png", 1, 1, {"Y"}, std::vector<std::uint8_t>{1});
  CHECK_THROWS_AS(load_heightmap(other, {.part = "0"}, 1 << 20), UsageError);
}

TEST_CASE("an attribute that announces more than the file holds is refused before it is read", "[files]") {
  const ScratchFolder scratch;
  const fs::path path = write_samples(scratch / "a.exr", 2, 2, {"Y"}, std::vector<float>{1, 2, 3, 4});
  CHECK_NOTHROW(check_exr_headers(path));
  const std::string bytes = read_text(path);
  std::string greedy = bytes.substr(0, 8) + std::string("comments\0string\0\xff\xff\xff\x7f", 20);
  CHECK_THROWS_WITH(check_exr_headers(write_text(scratch / "b.exr", greedy)),
                    Contains("b.exr") && Contains("comments") && Contains("2147483647"));
  CHECK_THROWS_WITH(check_exr_headers(write_text(scratch / "c.exr", bytes.substr(0, 40))), Contains("c.exr"));
  CHECK_THROWS_WITH(
      check_exr_headers(write_text(scratch / "d.exr", bytes.substr(0, 8) + std::string(300, 'x'))),
      Contains("d.exr"));
}
