#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "files/image_file.h"
#include "files/image_read.h"
#include "heightlight/error.h"
#include "scratch_folder.h"

using namespace heightlight;
using Catch::Contains;

namespace {

constexpr std::uint64_t kMemory = 1 << 30;

template <class T>
std::vector<T> samples_of(const StoredImage& image) {
  return std::get<std::vector<T>>(image.samples);
}

}  // namespace

TEST_CASE("An 8-bit picture comes back as it was written", "[files]") {
  const ScratchFolder scratch;
  Image<Rgb8> picture(3, 2);
  for (std::size_t i = 0; i < picture.size(); ++i)
    picture.values[i] = {static_cast<std::uint8_t>(40 * i), 7, 255};
  write_png(scratch / "picture.png", picture);
  const StoredImage image = read_image(scratch / "picture.png", FileFormat::png, kMemory);
  CHECK(image.width == 3);
  CHECK(image.height == 2);
  CHECK(image.channels == std::vector<std::string>{"R", "G", "B"});
  CHECK(samples_of<std::uint8_t>(image) ==
        std::vector<std::uint8_t>{0, 7, 255, 40, 7, 255, 80, 7, 255, 120, 7, 255, 160, 7, 255, 200, 7, 255});
}

TEST_CASE("A 16-bit PNG keeps every level", "[files]") {
  const ScratchFolder scratch;
  Image<std::uint16_t> levels(256, 256);
  for (std::size_t i = 0; i < levels.size(); ++i) levels.values[i] = static_cast<std::uint16_t>(i);
  write_png16(scratch / "levels.png", levels);
  const StoredImage image = read_image(scratch / "levels.png", FileFormat::png, kMemory);
  CHECK(image.sample_type == "uint16");
  CHECK(image.bits == 16);
  CHECK(image.channels == std::vector<std::string>{"Y"});
  CHECK(samples_of<std::uint16_t>(image) == levels.values);
}

TEST_CASE("A float image keeps every bit, NaN included", "[files]") {
  const ScratchFolder scratch;
  const std::string name = "map.exr";
  Map map(700, 300);  // taller than the rows written at a time
  for (std::size_t i = 0; i < map.size(); ++i) map.values[i] = std::sin(static_cast<float>(i));
  map(2, 3) = std::numeric_limits<float>::quiet_NaN();
  write_float_image(scratch / name, {{"Y", &map}}, {{"Comments", "E/pi"}});
  const StoredImage image = read_image(scratch / name, recognise_format(scratch / name), kMemory);
  CHECK(image.sample_type == "float");
  std::vector<float> samples = samples_of<float>(image);
  CHECK(std::isnan(samples[map.index(2, 3)]));
  samples[map.index(2, 3)] = map(2, 3) = 0;
  CHECK(samples == map.values);
}

TEST_CASE("Named channels of an EXR come back under their names", "[files]") {
  const ScratchFolder scratch;
  const Map red(2, 1, 0.25f);
  const Map green(2, 1, 0.5f);
  const Map blue(2, 1, 0.75f);
  write_float_image(scratch / "rgb.exr", {{"R", &red}, {"G", &green}, {"B", &blue}});
  const StoredImage image = read_image(scratch / "rgb.exr", FileFormat::openexr, kMemory);
  CHECK(image.channels == std::vector<std::string>{"R", "G", "B"});
  CHECK(samples_of<float>(image) == std::vector<float>{0.25f, 0.5f, 0.75f, 0.25f, 0.5f, 0.75f});
}

TEST_CASE("Text attributes stand in an EXR's header", "[files]") {
  const ScratchFolder scratch;
  const Map map(2, 2, 1.0f);
  write_float_image(scratch / "map.exr", {{"Y", &map}}, {{"quantity", "irradiance over pi"}});
  CHECK_THAT(read_text(scratch / "map.exr"), Contains("quantity") && Contains("irradiance over pi"));
}

TEST_CASE("A full disk is an error of every writer, which names the file", "[files]") {
  if (!std::filesystem::exists("/dev/full")) {
    WARN("SKIPPED: no /dev/full");
    return;
  }
  const std::string fault = "/dev/full: cannot be written: No space left on device";
  CHECK_THROWS_WITH(write_png("/dev/full", Image<Rgb8>(9, 9)), fault);
  CHECK_THROWS_WITH(write_png16("/dev/full", Image<std::uint16_t>(9, 9)), fault);
  const Map map(300, 300, 1.0f);
  CHECK_THROWS_WITH(write_float_image("/dev/full", {{"Y", &map}}), fault);
}

TEST_CASE("A folder that is not there is an error of every writer, which names the file", "[files]") {
  const ScratchFolder scratch;
  const auto path = scratch / "absent/map.png";
  const Map map(2, 2);
  CHECK_THROWS_WITH(write_png(path, Image<Rgb8>(2, 2)), Contains(path.string()));
  CHECK_THROWS_WITH(write_png16(path, Image<std::uint16_t>(2, 2)), Contains(path.string()));
  CHECK_THROWS_WITH(write_float_image(path, {{"Y", &map}}), Contains(path.string()));
}

TEST_CASE("SHA-256 agrees with the vectors of FIPS 180-4", "[files]") {
  const ScratchFolder scratch;
  CHECK(sha256_of_file(write_text(scratch / "abc", "abc")) ==
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256_of_file(write_text(scratch / "million", std::string(1'000'000, 'a'))) ==
        "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  // More than one block of the reader.
  CHECK(sha256_of_file(write_text(scratch / "zeros", std::string(4 << 20, '\0'))) ==
        "bb9f8df61474d25e71fa00722318cd387396ca1736605e1248821cc0de3d3af8");
  CHECK_THROWS_WITH(sha256_of_file(scratch / "absent"), Contains("absent") && Contains("no such file"));
}
