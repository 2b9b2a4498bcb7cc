#include <catch2/catch.hpp>
#include <numeric>

#include "files/image_file.h"
#include "files/image_read.h"
#include "files/map_size.h"
#include "heightlight/error.h"
#include "remedy.h"
#include "scratch_folder.h"
#include "write_samples.h"

using namespace heightlight;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kReadMemory = 1 << 30;

StoredImage read(const fs::path& path) { return read_image(path, recognise_format(path), kReadMemory); }

/// Samples that compress badly, so that a file's end is made of them.
template <class T>
std::vector<T> noise(std::size_t count) {
  std::vector<T> samples(count);
  std::uint32_t state = 1;
  for (T& sample : samples) {
    state = state * 1664525u + 1013904223u;
    sample = static_cast<T>(state >> 16);
  }
  return samples;
}

fs::path write_noise(const ScratchFolder& scratch, const std::string& name) {
  constexpr int kSide = 48;
  const std::vector<std::string> grey{"Y"};
  const fs::path path = scratch / name;
  if (name.ends_with(".exr") || name.ends_with("float.tif")) {
    return write_samples(path, kSide, kSide, grey, noise<float>(kSide * kSide));
  }
  if (name.ends_with(".hdr"))
    return write_samples(path, kSide, kSide, {"R", "G", "B"}, noise<float>(3 * kSide * kSide));
  if (name.ends_with("16.png") || name.ends_with("16.tif")) {
    return write_samples(path, kSide, kSide, grey, noise<std::uint16_t>(kSide * kSide));
  }
  return write_samples(path, kSide, kSide, grey, noise<std::uint8_t>(kSide * kSide));
}

}  // namespace

TEST_CASE("Formats are recognised by content, whatever the name", "[files]") {
  const ScratchFolder scratch;
  const auto [name, format] = GENERATE(table<std::string, FileFormat>({{"a.png", FileFormat::png},
                                                                       {"a.exr", FileFormat::openexr},
                                                                       {"a.tif", FileFormat::tiff},
                                                                       {"a.jpg", FileFormat::jpeg},
                                                                       {"a.hdr", FileFormat::hdr},
                                                                       {"a.tga", FileFormat::targa}}));
  write_noise(scratch, name);
  fs::rename(scratch / name, scratch / "map.dat");
  CHECK(recognise_format(scratch / "map.dat") == format);
  CHECK(read(scratch / "map.dat").width == 48);
}

TEST_CASE("An Esri grid is known by its first keyword or by its name", "[files]") {
  const ScratchFolder scratch;
  CHECK(recognise_format(write_text(scratch / "grid.txt", "  NCOLS 2\n")) == FileFormat::esri_grid);
  CHECK(recognise_format(write_text(scratch / "grid.ASC", "what?")) == FileFormat::esri_grid);
}

TEST_CASE("What is no file of samples is refused with its name and the reason", "[files]") {
  const ScratchFolder scratch;
  const auto fault = [](const fs::path& path, const std::string& reason) {
    CHECK_THROWS_WITH(recognise_format(path), Contains(path.string()) && Contains(reason));
  };
  fault(write_text(scratch / "notes.png", "Dear diary, today I rendered a teapot.\n"), "holds text");
  fault(write_text(scratch / "archive.png", std::string("PK\x03\x04\x14\x00\x00\x00", 8)),
        "is a zip archive; unpack it");
  fault(write_text(scratch / "empty.png", ""), "is empty");
  fault(write_text(scratch / "short.png", "RIFF\x1a"), "is no image");
  fault(scratch / "absent.png", "no such file");
  fault(scratch.path(), "directory");
  fault("/dev/null", "not a regular file");
  const fs::path secret = write_text(scratch / "secret.png", "x");
  fs::permissions(secret, fs::perms::none);
  if (std::ifstream(secret).good()) {
    WARN("SKIPPED: this user may read every file");
    return;
  }
  fault(secret, "cannot be read");
}

TEST_CASE("A file cut anywhere is an error that names it", "[files]") {
  const ScratchFolder scratch;
  const std::string name =
      GENERATE("8.png", "16.png", "a.exr", "float.tif", "16.tif", "a.jpg", "a.hdr", "a.tga");
  const fs::path whole = write_noise(scratch, name);
  REQUIRE_NOTHROW(read(whole));
  const std::string bytes = read_text(whole);
  // OpenImageIO's Targa files end in a thumbnail and a footer, which are not samples.
  const std::size_t end = name == "a.tga" ? 48 * 48 : bytes.size() - 1;
  for (const std::size_t size : {std::size_t{12}, std::size_t{30}, end / 10, end / 2, end * 9 / 10, end}) {
    const fs::path cut = write_text(scratch / ("cut_" + name), bytes.substr(0, size));
    CAPTURE(name, size, bytes.size());
    CHECK_THROWS_WITH(read(cut), Contains(cut.string()));
  }
}

TEST_CASE("A damaged byte in a PNG is noticed", "[files]") {
  const ScratchFolder scratch;
  std::string bytes = read_text(write_noise(scratch, "16.png"));
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  CHECK_THROWS_WITH(read(write_text(scratch / "16.png", bytes)), Contains("damaged") && Contains("16.png"));
}

TEST_CASE("Sample types keep their values and are named", "[files]") {
  const ScratchFolder scratch;
  const auto check = [&](auto first, const std::string& name, bool is_integer) {
    using T = decltype(first);
    const std::vector<T> samples{first, 1, 2, 3, 4, std::numeric_limits<T>::max()};
    const StoredImage image = read(write_samples(scratch / (name + ".tif"), 3, 2, {"Y"}, samples));
    CHECK(image.sample_type == name);
    CHECK(image.is_integer == is_integer);
    CHECK(image.bits == static_cast<int>(sizeof(T)) * 8);
    CHECK(std::get<std::vector<T>>(image.samples) == samples);
  };
  check(std::uint8_t{0}, "uint8", true);
  check(std::uint16_t{0}, "uint16", true);
  check(std::int16_t{-32768}, "int16", true);
  check(std::uint32_t{0}, "uint32", true);
  check(-2.5f, "float", false);
  check(1e6 + 1e-9, "double", false);
}

TEST_CASE("64-bit TIFFs that OpenImageIO reads as zeros are refused", "[files]") {
  const ScratchFolder scratch;
  const std::vector<double> row{1, 2, 3};
  CHECK_THROWS_WITH(read(write_samples(scratch / "row.tif", 3, 1, {"Y"}, row)), Contains("row.tif: 64-bit"));

  OIIO::ImageSpec spec(16, 16, 1, OIIO::TypeDesc::DOUBLE);
  spec.tile_width = spec.tile_height = 16;
  const auto output = OIIO::ImageOutput::create("tiff");
  REQUIRE(output->open((scratch / "tiles.tif").string(), spec));
  REQUIRE(output->write_image(OIIO::TypeDesc::DOUBLE, std::vector<double>(256, 7).data()));
  REQUIRE(output->close());
  CHECK_THROWS_WITH(read(scratch / "tiles.tif"), Contains("tiles.tif: 64-bit"));
}

TEST_CASE("Half samples become float without loss", "[files]") {
  const ScratchFolder scratch;
  const std::vector<float> samples{0.0f, 0.5f, -1.25f, 65504.0f};
  const StoredImage image =
      read(write_samples(scratch / "half.exr", 2, 2, {"Y"}, samples, OIIO::TypeDesc(OIIO::TypeDesc::HALF)));
  CHECK(image.sample_type == "half");
  CHECK(image.bits == 16);
  CHECK(std::get<std::vector<float>>(image.samples) == samples);
}

TEST_CASE("Alpha is not multiplied into the samples", "[files]") {
  const ScratchFolder scratch;
  const std::string name = GENERATE("a.tga", "a.tif", "a.png");
  const std::vector<std::uint8_t> samples{200, 200, 200, 0, 100, 100, 100, 128};
  const StoredImage image = read(write_samples(scratch / name, 2, 1, {"R", "G", "B", "A"}, samples));
  CHECK(image.channels == std::vector<std::string>{"R", "G", "B", "A"});
  CHECK(std::get<std::vector<std::uint8_t>>(image.samples) == samples);
}

TEST_CASE("A header that promises too much is refused before samples are read", "[files]") {
  const ScratchFolder scratch;
  const fs::path path = scratch / "map.png";
  CHECK_NOTHROW(check_map_size(path, 1024, 1024, 8, 8 << 20));
  CHECK_THROWS_WITH(check_map_size(path, 1024, 1024, 8, 5 << 20),
                    Contains("map.png") && Contains("8.0 MiB") && Contains("5.0 MiB"));
  CHECK(remedy_of([&] { check_map_size(path, 1024, 1024, 8, 5 << 20); }) == "memory 8M");
  CHECK_THROWS_WITH(check_map_size(path, 0, 7, 8, kReadMemory), Contains("map.png") && Contains("0 x 7"));
  CHECK_THROWS_WITH(check_map_size(path, 1 << 20, 1, 8, kReadMemory), Contains("too many"));
  CHECK_THROWS_WITH(check_map_size(path, 65536, 32769, 1, ~std::uint64_t{0}), Contains("too many"));
}

TEST_CASE("A PNG that announces gigabytes or nothing is refused by its header", "[files]") {
  const ScratchFolder scratch;
  const auto with_size = [&](unsigned char high, unsigned char low) {
    std::string bytes = read_text(write_noise(scratch, "16.png"));
    for (const std::size_t place : {std::size_t{16}, std::size_t{20}}) {
      bytes[place] = bytes[place + 1] = 0;
      bytes[place + 2] = static_cast<char>(high);
      bytes[place + 3] = static_cast<char>(low);
    }
    return write_text(scratch / "fake.png", bytes);
  };
  CHECK_THROWS_WITH(read(with_size(0x7f, 0xff)), Contains("fake.png"));
  CHECK_THAT(remedy_of([&] { read(with_size(0x7f, 0xff)); }), Catch::StartsWith("memory"));
  CHECK_THROWS_WITH(read(with_size(0, 0)), Contains("fake.png") && Contains("0 x 0"));
}

TEST_CASE("Every format obeys the memory limit", "[files]") {
  const ScratchFolder scratch;
  const std::string name = GENERATE("8.png", "16.png", "a.exr", "float.tif", "a.jpg", "a.hdr", "a.tga");
  const fs::path path = write_noise(scratch, name);
  CHECK_THROWS_WITH(read_image(path, recognise_format(path), 10'000), Contains(name));
  CHECK_THAT(remedy_of([&] { read_image(path, recognise_format(path), 10'000); }),
             Catch::StartsWith("memory"));
}
