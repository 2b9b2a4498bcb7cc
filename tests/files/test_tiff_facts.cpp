#include <catch2/catch.hpp>

#include "files/image_read.h"
#include "files/tiff_facts.h"
#include "heightlight/error.h"
#include "heightlight/files.h"
#include "scratch_folder.h"
#include "tiff_bytes.h"
#include "write_samples.h"

using namespace heightlight;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kTiffMemory = 1 << 30;
const std::vector<float> kFour{1, 2, 3, 4};

LoadedHeightmap load_tiff(const fs::path& path, const LoadOptions& options = {}) {
  return load_heightmap(path, options, kTiffMemory);
}

}  // namespace

TEST_CASE("a pixel scale is the spacing, of a map that stands alone", "[files]") {
  const ScratchFolder scratch;
  const fs::path path = write_text(scratch / "g.tif", TiffBytes(2, 2, kFour, 3)
                                                          .add_doubles(33550, {30, 20, 0})
                                                          .add_doubles(33922, {0, 0, 0, 5e5, 4e6, 0})
                                                          .bytes());
  const LoadedHeightmap loaded = load_tiff(path);
  CHECK(loaded.map.spacing.x == 30);
  CHECK(loaded.map.spacing.y == 20);
  CHECK(loaded.map.boundary == Boundary::open);
  CHECK(load_tiff(path, {.texel = Spacing{1, 1}}).map.spacing.x == 1);
  CHECK(load_tiff(path, {.boundary = Boundary::tile}).map.boundary == Boundary::tile);
}

TEST_CASE("a pixel scale in degrees is measured in metres", "[files]") {
  const ScratchFolder scratch;
  const fs::path path = write_text(scratch / "d.tif", TiffBytes(2, 2, kFour, 3)
                                                          .add_doubles(33550, {0.001, 0.001, 0})
                                                          .add_doubles(33922, {0, 0, 0, 10, 60.001, 0})
                                                          .add_shorts(34735, {1, 1, 0, 1, 1024, 0, 1, 2})
                                                          .bytes());
  const LoadedHeightmap loaded = load_tiff(path);
  CHECK(loaded.map.spacing.x == Approx(55.8).margin(0.005));  // half of what a degree is at the equator
  CHECK_THAT(loaded.warnings.at(0).message, Contains("0.001 x 0.001 degrees"));
}

TEST_CASE("integers of an elevation model are metres, those of a picture are stretched", "[files]") {
  const ScratchFolder scratch;
  const std::vector<std::int16_t> metres{500, 510, 520, 530};
  const fs::path path = write_text(scratch / "m.tif", TiffBytes(2, 2, metres, 2).bytes());
  CHECK(relief(load_tiff(path, {.texel = Spacing{30, 30}}).map) == 30);
  CHECK(load_tiff(path, {.texel = Spacing{30, 30}}).map.base == 500);
  CHECK(relief(load_tiff(path).map) == Approx(0.1));
  CHECK(load_tiff(path).facts.is_stretched);
}

TEST_CASE("white is zero: larger numbers are lower, at 8 bits and at 16", "[files]") {
  const ScratchFolder scratch;
  const std::vector<std::uint8_t> bytes{0, 10, 20, 250};
  const std::vector<std::uint16_t> words{0, 10, 20, 250};
  const LoadedHeightmap eight =
      load_tiff(write_text(scratch / "8.tif", TiffBytes(2, 2, bytes, 1, 0).bytes()));
  const LoadedHeightmap sixteen =
      load_tiff(write_text(scratch / "16.tif", TiffBytes(2, 2, words, 1, 0).bytes()));
  for (const LoadedHeightmap* loaded : {&eight, &sixteen}) {
    CHECK(loaded->facts.white_is_zero);
    CHECK(loaded->facts.highest == 250);
    CHECK(loaded->map.height.values[0] == Approx(0.1));
    CHECK(loaded->map.height.values[3] == 0);
  }
  CHECK(eight.map.height == sixteen.map.height);
  const LoadedHeightmap turned = load_tiff(scratch / "8.tif", {.invert = true});
  CHECK(turned.map.height.values[0] == 0);
}

TEST_CASE("a flipped bit in deflated samples is noticed, whatever their type", "[files]") {
  const ScratchFolder scratch;
  const std::string kind = GENERATE("float", "uint16", "uint8");
  constexpr int kSide = 64;
  std::vector<float> heights(kSide * kSide);
  for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = static_cast<float>(i * 7919 % 251);
  OIIO::ImageSpec spec(kSide, kSide, 1, OIIO::TypeDesc(kind.c_str()));
  spec.attribute("compression", "zip");
  const fs::path path = scratch / "z.tif";
  const auto output = OIIO::ImageOutput::create(path.string());
  REQUIRE(output->open(path.string(), spec));
  REQUIRE(output->write_image(OIIO::TypeDesc::FLOAT, heights.data()));
  REQUIRE(output->close());
  const std::string whole = read_text(path);
  const StoredImage right = read_image(path, FileFormat::tiff, kTiffMemory);
  int noticed = 0;
  for (std::size_t at = 200; at < whole.size(); at += whole.size() / 60) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 4);
    const fs::path flipped = write_text(scratch / "f.tif", bytes);
    try {
      const StoredImage image = read_image(flipped, FileFormat::tiff, kTiffMemory);
      CHECK((image.samples == right.samples));  // a bit that no sample hangs on
    } catch (const Error&) {
      ++noticed;
    }
  }
  CHECK(noticed > 20);
}

TEST_CASE("a TIFF whose directory is cut short is named", "[files]") {
  const ScratchFolder scratch;
  const std::string bytes = TiffBytes(2, 2, kFour, 3).add_text(42113, "-9999").bytes();
  for (const std::size_t size : {std::size_t{9}, bytes.size() / 2}) {
    const fs::path cut = write_text(scratch / "c.tif", bytes.substr(0, size));
    CHECK_THROWS_WITH(load_tiff(cut), Contains("c.tif"));
  }
}
