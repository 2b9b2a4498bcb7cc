// Checks whether the error wanted is reached: A and totals at albedos of .3, .8 and .95, by walks planned for
// an error, are compared with exact slices along many azimuths at every texel. The maps are every synthetic
// shape and parts of real maps, at several reliefs, with both boundaries and several seeds. The output
// includes what the solution's own check says, and whether it reported a miss.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "heightlight/files.h"
#include "heightlight/synth.h"
#include "solve/promise.h"

namespace heightlight {
namespace {

struct Ground {
  std::string name;
  Image<float> heights;  ///< from 0 to 1
};

/// The middle of a map, scaled to [0, 1].
Image<float> cut_middle(const Image<float>& heights, int side) {
  Image<float> part(std::min(side, heights.width), std::min(side, heights.height));
  const int first_row = (heights.height - part.height) / 2;
  const int first_column = (heights.width - part.width) / 2;
  float lowest = std::numeric_limits<float>::infinity();
  float highest = -lowest;
  for (int row = 0; row < part.height; ++row) {
    for (int column = 0; column < part.width; ++column) {
      part(row, column) = heights(first_row + row, first_column + column);
      lowest = std::min(lowest, part(row, column));
      highest = std::max(highest, part(row, column));
    }
  }
  for (float& height : part.values) height = highest > lowest ? (height - lowest) / (highest - lowest) : 0;
  return part;
}

std::vector<Ground> list_grounds(int side) {
  std::vector<Ground> grounds;
  for (const char* shape : {"brick", "cobbles", "fbm", "sines", "steps", "trench", "bowl"})
    grounds.push_back({shape, synthesize(shape, side, 1)});
  const std::filesystem::path data = std::filesystem::path(HEIGHTLIGHT_SHARED_DIR) / "data";
  for (const char* file : {"material/Ground054_height16.png", "material/MetalWalkway006_height16.png",
                           "material/DiamondPlate008C_height16.png", "material/Leather031_height16.png",
                           "material/materialx_plain_heightmap.png", "terrain/SRTMGL3_boulder.asc"}) {
    LoadOptions options;
    if (std::string(file).ends_with(".asc")) options.texel = Spacing{70.8, 92.6};
    const LoadedHeightmap loaded = load_heightmap(data / file, options, ~0ULL);
    grounds.push_back({std::filesystem::path(file).stem().string(), cut_middle(loaded.map.height, side)});
  }
  return grounds;
}

Surface make_surface(const Image<float>& unit, double relief, Boundary boundary) {
  Heightmap map;
  map.height = unit;
  for (float& height : map.height.values) height *= static_cast<float>(relief);
  map.spacing = {1.0 / unit.width, 1.0 / unit.width};
  map.boundary = boundary;
  return build_surface(std::move(map));
}

void run(int side, double error, int azimuths) {
  std::printf("map,relief,boundary,seed,A,A_said,total_.3,said,total_.8,said,total_.95,said,told\n");
  for (const Ground& ground : list_grounds(side)) {
    for (const double relief : {0.03, 0.1, 0.4, 1.0}) {
      const std::uint64_t seed = 1 + (relief > 0.05) + (relief > 0.3);
      const Boundary boundary = relief == 0.4 ? Boundary::open : Boundary::tile;
      const Promise promise =
          try_promise(make_surface(ground.heights, relief, boundary), error, seed, azimuths);
      std::printf("%s,%g,%s,%d,%.5f,%.5f", ground.name.c_str(), relief, to_string(boundary),
                  static_cast<int>(seed), promise.sky, promise.sky_said);
      for (std::size_t t = 0; t < promise.total.size(); ++t)
        std::printf(",%.5f,%.5f", promise.total[t], promise.total_said[t]);
      std::printf(",%d\n", promise.told ? 1 : 0);
      std::fflush(stdout);
    }
  }
}

}  // namespace
}  // namespace heightlight

int main(int argc, char** argv) {
  CLI::App app{"Whether the error wanted is reached, on many maps"};
  int side = 128;
  double error = 0.002;
  int azimuths = 256;
  app.add_option("--side", side, "of the maps, in texels (128)");
  app.add_option("--error", error, "wanted (0.002)");
  app.add_option("--azimuths", azimuths, "of exact slices (256)");
  CLI11_PARSE(app, argc, argv);
  try {
    heightlight::run(side, error, azimuths);
  } catch (const std::exception& error_found) {
    std::fprintf(stderr, "heightlight_promise_bench: %s\n", error_found.what());
    return 1;
  }
  return 0;
}
