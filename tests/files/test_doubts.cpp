#include <catch2/catch.hpp>
#include <cmath>

#include "files/image_file.h"
#include "heightlight/files.h"
#include "heightlight/synth.h"
#include "scratch_folder.h"

using namespace heightlight;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

/// A shape as `synth` writes it, with so many levels.
LoadedHeightmap load_shape(const ScratchFolder& scratch, const std::string& shape, int size, int levels) {
  const Image<float> heights = synthesize(shape, size, 1);
  Image<std::uint16_t> stored(size, size);
  const double most = levels - 1;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    stored.values[i] =
        static_cast<std::uint16_t>(std::lround(double{heights.values[i]} * most) * (65535 / (levels - 1)));
  }
  const fs::path path = scratch / (shape + ".png");
  write_png16(path, stored);
  return load_heightmap(path, {}, 1 << 28);
}

std::string all_warnings(const LoadedHeightmap& loaded) {
  std::string text;
  for (const Warning& warning : loaded.warnings) text += warning.message + '\n';
  return text;
}

}  // namespace

TEST_CASE("maps made here are not suspected of missing samples, nor of terraces", "[files]") {
  const ScratchFolder scratch;
  const int size = GENERATE(16, 64, 200);
  for (const SynthShape& shape : synth_shapes()) {
    CAPTURE(shape.name, size);
    const std::string warnings = all_warnings(load_shape(scratch, shape.name, size, 65536));
    CHECK_THAT(warnings, !Contains("far ") && !Contains("terraces"));
    if (shape.tiles) CHECK_THAT(warnings, !Contains("edges"));
  }
}

TEST_CASE("terraces are told with their height", "[files]") {
  const ScratchFolder scratch;
  for (const char* shape : {"fbm", "brick", "sines"}) {
    const std::string warnings = all_warnings(load_shape(scratch, shape, 256, 52));
    CAPTURE(shape);
    CHECK_THAT(warnings, Contains("terraces 0.002 high"));  // of 51 steps over a tenth of the width
  }
}

TEST_CASE("edges that do not meet are told, where the map is to tile", "[files]") {
  const ScratchFolder scratch;
  const Image<float> whole = synthesize("fbm", 96, 1);
  Image<float> part(61, 61);
  for (int row = 0; row < 61; ++row) {
    for (int column = 0; column < 61; ++column) part(row, column) = whole(row, column);
  }
  write_float_image(scratch / "part.exr", {{"Y", &part}});
  const LoadedHeightmap tiled = load_heightmap(scratch / "part.exr", {.relief = 0.1}, 1 << 28);
  CHECK_THAT(all_warnings(tiled), Contains("edges do not meet"));
  const LoadedHeightmap open =
      load_heightmap(scratch / "part.exr", {.relief = 0.1, .boundary = Boundary::open}, 1 << 28);
  CHECK_THAT(all_warnings(open), !Contains("edges"));
}

TEST_CASE("reliefs and slopes that hardly anyone means are told", "[files]") {
  const ScratchFolder scratch;
  const Image<float> heights = synthesize("fbm", 64, 1);
  write_float_image(scratch / "f.exr", {{"Y", &heights}});
  const auto remedy = [&](const LoadOptions& options) {
    const LoadedHeightmap loaded = load_heightmap(scratch / "f.exr", options, 1 << 28);
    return loaded.warnings.empty() ? "" : loaded.warnings[0].remedy;
  };
  CHECK(remedy({}) == "relief 0.1");
  CHECK(remedy({.relief = 0.1}).empty());
  CHECK(remedy({.relief = 5}) == "texel");
  CHECK(remedy({.relief = 0.9}) == "relief");
  CHECK(remedy({.width = 10}).empty());
}
