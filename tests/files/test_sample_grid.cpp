#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <numbers>

#include "heightlight/error.h"
#include "heightlight/files.h"
#include "scratch_folder.h"

// Samples one after the other: NumPy arrays, SRTM tiles, raw heights.

using namespace heightlight;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kEnough = 1 << 30;

/// The bytes of numbers in either order.
template <class T>
std::string bytes_of(const std::vector<T>& values, bool big_endian = false) {
  std::string bytes;
  for (const T value : values) {
    std::string one(sizeof value, '\0');
    std::memcpy(one.data(), &value, sizeof value);
    if (big_endian == (std::endian::native == std::endian::little)) std::reverse(one.begin(), one.end());
    bytes += one;
  }
  return bytes;
}

/// As numpy.save writes it, version 1.
std::string numpy(const std::string& type, const std::string& shape, const std::string& samples,
                  const std::string& by_columns = "False") {
  std::string header =
      "{'descr': '" + type + "', 'fortran_order': " + by_columns + ", 'shape': " + shape + ", }";
  header.resize(117, ' ');
  header += '\n';
  return std::string("\x93NUMPY\x01\x00", 8) + std::string("\x76\x00", 2) + header + samples;
}

std::string fault_of(const fs::path& path, const LoadOptions& options = {}) {
  try {
    load_heightmap(path, options, kEnough);
  } catch (const Error& error) {
    return error.what() + (error.remedy.empty() ? "" : " (" + error.remedy + ")");
  }
  return "";
}

/// World heights.
std::vector<double> heights_of(const LoadedHeightmap& loaded) {
  std::vector<double> heights;
  for (const float height : loaded.map.height.values) heights.push_back(double{height} + loaded.map.base);
  return heights;
}

/// A tile of 3″ that rises to the east by a metre per sample, with a void.
std::string srtm_tile() {
  constexpr int kSide = 1201;
  std::vector<std::int16_t> samples;
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) samples.push_back(static_cast<std::int16_t>(column - 100));
  }
  samples[5] = -32768;
  return bytes_of(samples, true);
}

// Lengths of a degree on the ellipsoid of WGS 84, from its radii of curvature.
constexpr double kRadius = 6378137;
constexpr double kEccentricity = 0.0066943799901;  // squared

double flattening(double latitude) {
  const double sine = std::sin(latitude * std::numbers::pi / 180);
  return 1 - kEccentricity * sine * sine;
}

double metres_east(double latitude) {
  const double radian = std::numbers::pi / 180;
  return radian * kRadius * std::cos(latitude * radian) / std::sqrt(flattening(latitude));
}

double metres_north(double latitude) {
  return std::numbers::pi / 180 * kRadius * (1 - kEccentricity) / std::pow(flattening(latitude), 1.5);
}

}  // namespace

TEST_CASE("NumPy arrays of floats are heights as they are, in any order and layout", "[files]") {
  const ScratchFolder scratch;
  const std::vector<double> expected{1.5, 2, -3, 4, 5, 6};
  const std::vector<float> rows{1.5F, 2, -3, 4, 5, 6};
  const std::vector<float> columns{1.5F, 4, 2, 5, -3, 6};
  write_text(scratch / "little.npy", numpy("<f4", "(2, 3)", bytes_of(rows)));
  write_text(scratch / "big.npy", numpy(">f4", "(2, 3)", bytes_of(rows, true)));
  write_text(scratch / "fortran.npy", numpy("<f4", "(2, 3)", bytes_of(columns), "True"));
  write_text(scratch / "double.npy", numpy("<f8", "(2, 3)", bytes_of(expected)));
  write_text(
      scratch / "half.npy",
      numpy("<f2", "(2, 3)", bytes_of<std::uint16_t>({0x3e00, 0x4000, 0xc200, 0x4400, 0x4500, 0x4600})));
  for (const char* name : {"little.npy", "big.npy", "fortran.npy", "double.npy", "half.npy"}) {
    INFO(name);
    const LoadedHeightmap loaded = load_heightmap(scratch / name, {}, kEnough);
    CHECK(loaded.map.height.width == 3);
    CHECK(heights_of(loaded) == expected);
    CHECK(loaded.facts.format == "numpy array");
    CHECK_FALSE(loaded.facts.is_stretched);
  }
}

TEST_CASE("NumPy's integers are levels, or heights where they say so", "[files]") {
  const ScratchFolder scratch;
  write_text(scratch / "levels.npy", numpy("<u2", "(1, 3)", bytes_of<std::uint16_t>({100, 200, 300})));
  write_text(scratch / "metres.npy", numpy("<i2", "(1, 3)", bytes_of<std::int16_t>({-100, 0, 300})));
  const LoadedHeightmap levels = load_heightmap(scratch / "levels.npy", {}, kEnough);
  CHECK(levels.facts.is_stretched);
  CHECK(relief(levels.map) == Approx(0.1));
  const LoadedHeightmap metres = load_heightmap(scratch / "metres.npy", {.texel = Spacing{30, 30}}, kEnough);
  CHECK(heights_of(metres) == std::vector<double>{-100, 0, 300});
}

TEST_CASE("a scale and an offset make heights of levels", "[files]") {
  const ScratchFolder scratch;
  write_text(scratch / "terrain.r16", bytes_of<std::uint16_t>({32768, 32768 + 128, 32768 - 256, 0}));
  const LoadOptions options{.size = {{2, 2}}, .scale = 1.0 / 128, .offset = -256};
  const LoadedHeightmap loaded = load_heightmap(scratch / "terrain.r16", options, kEnough);
  CHECK(heights_of(loaded) == std::vector<double>{0, 1, -2, -256});
  CHECK_FALSE(loaded.facts.is_stretched);
  const LoadedHeightmap depths =
      load_heightmap(scratch / "terrain.r16", {.size = {{2, 2}}, .scale = 2, .invert = true}, kEnough);
  CHECK(heights_of(depths)[3] == 0);
  CHECK(relief(depths.map) == 2 * (32768 + 128));
  CHECK_THAT(fault_of(scratch / "terrain.r16", {.relief = 1, .size = {{2, 2}}, .scale = 2}),
             Contains("scale: excludes a relief"));
  CHECK_THAT(fault_of(scratch / "terrain.r16", {.size = {{2, 2}}, .scale = -1}), Contains("scale"));
}

TEST_CASE("raw samples want their size, and tell their type by it", "[files]") {
  const ScratchFolder scratch;
  write_text(scratch / "eight.raw", std::string("\x00\x7f\xff\x01", 4));
  write_text(scratch / "sixteen.raw", bytes_of<std::uint16_t>({1, 2, 3, 4}));
  write_text(scratch / "big.r16", bytes_of<std::uint16_t>({1, 2, 3, 4}, true));
  write_text(scratch / "floats.r32", bytes_of<float>({1, 2.5F, 3, 4}));
  const LoadOptions square{.size = {{2, 2}}};
  CHECK(load_heightmap(scratch / "eight.raw", square, kEnough).facts.sample_type == "uint8");
  CHECK(load_heightmap(scratch / "sixteen.raw", square, kEnough).facts.highest == 4);
  CHECK(load_heightmap(scratch / "big.r16", {.size = {{2, 2}}, .big_endian = true}, kEnough).facts.highest ==
        4);
  CHECK(heights_of(load_heightmap(scratch / "floats.r32", square, kEnough))[1] == 2.5);
  CHECK_THAT(fault_of(scratch / "sixteen.raw"),
             Contains("sixteen.raw: holds raw samples") && Contains("(size 2x2)"));
  CHECK_THAT(fault_of(scratch / "sixteen.raw", {.size = {{3, 2}}}),
             Contains("has 8 bytes, which 3 × 2 samples of 8, 16 or 32 bits do not have"));
  write_text(scratch / "array.npy", numpy("<f4", "(1, 1)", bytes_of<float>({1})));
  CHECK_THAT(fault_of(scratch / "array.npy", {.size = {{1, 1}}}), Contains("tells its size itself"));
}

TEST_CASE("an SRTM tile is metres, with voids, at the place that its name says", "[files]") {
  const ScratchFolder scratch;
  write_text(scratch / "N45E006.hgt", srtm_tile());
  const LoadedHeightmap loaded = load_heightmap(scratch / "N45E006.hgt", {}, kEnough);
  CHECK_THAT(loaded.warnings.at(0).message, Contains("degrees are 65.13 x 92.62 m"));
  REQUIRE(loaded.place);
  CHECK(loaded.place->system == "EPSG:4326");
  CHECK(loaded.map.boundary == Boundary::open);
  CHECK(loaded.map.spacing.x == Approx(metres_east(45.5) / 1200).epsilon(1e-6));
  CHECK(loaded.map.spacing.y == Approx(metres_north(45.5) / 1200).epsilon(1e-6));
  CHECK(std::isnan(loaded.map.height(0, 5)));
  CHECK(heights_of(loaded)[0] == -100);
  CHECK(relief(loaded.map) == 1200);
  fs::rename(scratch / "N45E006.hgt", scratch / "s12w077.HGT");
  const LoadedHeightmap southern =
      load_heightmap(scratch / "s12w077.HGT", {.degrees_in_metres = true}, kEnough);
  CHECK(southern.map.spacing.x == Approx(metres_east(-11.5) / 1200).epsilon(1e-6));
  fs::rename(scratch / "s12w077.HGT", scratch / "tile.hgt");
  CHECK_THAT(fault_of(scratch / "tile.hgt", {.degrees_in_metres = true}),
             Contains("does not tell a spacing"));
  CHECK(heights_of(load_heightmap(scratch / "tile.hgt", {.texel = Spacing{65, 93}}, kEnough))[0] == -100);
}

TEST_CASE("damaged arrays are refused with their file and the reason", "[files]") {
  const ScratchFolder scratch;
  const auto check = [&](const std::string& bytes, const char* reason) {
    write_text(scratch / "bad.npy", bytes);
    CHECK_THAT(fault_of(scratch / "bad.npy"), Contains("bad.npy: ") && Contains(reason));
  };
  check("\x93NUMPY", "truncated");
  check(numpy("<f4", "(2, 2)", "123"), "truncated");
  check(numpy("<f4", "(2, 2, 3)", ""), "3 dimensions");
  check(numpy("<f4", "(4,)", ""), "1 dimensions");
  check(numpy("<f4", "(2, x)", ""), "damaged");
  check(numpy("<c8", "(2, 2)", ""), "of type <c8");
  check(numpy("|O", "(2, 2)", ""), "of type |O");
  check(numpy("<f\n\x1b", "(2, 2)", ""), "of type <f?");
  check(numpy("<f4", "(0, 2)", ""), "0");
  check(numpy("<f4", "(999999999, 999999999)", ""), "bad.npy");
  check(std::string("\x93NUMPY\x01\x00\x10\x00{'descr': '<f4'}", 26), "no shape");
  check(std::string("\x93NUMPY\x09\x00\x10\x00{'descr': '<f4'}", 26), "version");
}
