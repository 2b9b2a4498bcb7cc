// Seconds per megatexel, memory and error of `bake`: reads a 16-bit PNG and writes ao, bent-normal and
// multibounce as 16-bit PNGs, at the default error. The walk of the sky alone, as planned, is measured for
// comparison.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bake/bake.h"
#include "base/byte_size.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "files/image_file.h"
#include "heightlight/error.h"
#include "heightlight/synth.h"
#include "visibility/horizon_sky.h"

namespace heightlight {
namespace {

struct Options {
  std::vector<std::string> maps{"brick", "fbm"};
  std::vector<int> sizes{512, 1024, 2048};
  double error = BakeOptions{}.error;
  std::uint64_t memory = std::uint64_t{4} << 30;
};

std::filesystem::path write_map(const std::filesystem::path& folder, const std::string& shape, int size) {
  const Image<float> heights = synthesize(shape, size, 1);
  Image<std::uint16_t> levels(size, size);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    levels.values[i] = static_cast<std::uint16_t>(std::lround(65535 * heights.values[i]));
  }
  const std::filesystem::path path = folder / (shape + std::to_string(size) + ".png");
  write_png16(path, levels);
  return path;
}

void measure(const Options& options, const std::filesystem::path& folder, const std::string& shape,
             int size) {
  const std::filesystem::path path = write_map(folder, shape, size);
  BakeOptions bake;
  bake.maps = {MaterialMap::ao, MaterialMap::bent_normal, MaterialMap::multibounce};
  bake.error = options.error;
  bake.memory = options.memory;
  const Stopwatch watch;
  LoadedHeightmap loaded = load_heightmap(path, {}, options.memory);
  const double load = watch.elapsed().wall;
  bake_material(std::move(loaded), bake,
                {.source = path, .inputs = {path}, .folder = folder / "out", .name = "m"});
  const Cost all = watch.elapsed();
  const std::uint64_t peak = peak_memory();
  const nlohmann::json sidecar = nlohmann::json::parse(std::ifstream(folder / "out" / "m_bake.json"));
  const nlohmann::json& time = sidecar["time_s"];
  const nlohmann::json& errors = sidecar["errors"];
  const nlohmann::json& visibility = sidecar["visibility"];
  const SkyPlan plan{.walk = {.azimuths = visibility["azimuths"],
                              .samples_per_octave = visibility["fineness"],
                              .peak_share = visibility["peak_share"]},
                     .full_from = visibility["full_from"]};
  const Surface surface = build_surface(load_heightmap(path, {}, options.memory).map);
  const HeightPyramid pyramid = build_height_pyramid(surface);
  const Stopwatch walk_watch;
  walk_horizon_sky(surface, pyramid, plan);
  const Cost walk = walk_watch.elapsed();
  const double megatexels = 1e-6 * size * size;
  const auto per = [megatexels](double seconds) { return seconds / megatexels; };
  std::printf("%-6s %5d %7.3f %7.3f %7.3f %7.3f %7.3f %7.3f %7.3f %7.3f %6.2f %7.0f %8.5f %8.3f %8.5f\n",
              shape.c_str(), size, per(walk.wall), per(load), per(time["visibility"]), per(time["bounces"]),
              per(time["check"]), per(time["output"]), per(all.wall), per(all.core), all.others / all.wall,
              1e-6 * static_cast<double>(peak), errors["ao_rmse"].get<double>(),
              errors["bent_normal_rmse_degrees"].get<double>(), errors["multibounce_rmse"].get<double>());
  std::fflush(stdout);
}

void run(const Options& options) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("heightlight-bake-bench-" + std::to_string(getpid()));
  std::filesystem::create_directory(folder);
  std::printf(
      "ao, bent-normal and multibounce of 16-bit maps, error wanted %g, at most %s, %d threads\n"
      "wall seconds per megatexel, of the sky's walk alone and of each step; core seconds of all\n"
      "others: processors that other programs kept busy meanwhile; peak: MB of the process so far\n"
      "%-6s %5s %7s %7s %7s %7s %7s %7s %7s %7s %6s %7s %8s %8s %8s\n",
      options.error, format_byte_size(options.memory).c_str(), thread_count(), "map", "size", "walk", "load",
      "visib.", "bounces", "check", "output", "all", "core", "others", "peak", "A", "degrees", "total");
  for (const std::string& map : options.maps) {
    for (const int size : options.sizes) measure(options, folder, map, size);
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace heightlight

int main(int argument_count, char** arguments) {
  try {
    heightlight::Options options;
    CLI::App app("Seconds per megatexel, memory and error of bake; the head of the source says more");
    app.add_option("--maps", options.maps, "shapes of `heightlight synth` (brick,fbm)")->delimiter(',');
    app.add_option("--sizes", options.sizes, "texels along an edge (512,1024,2048)")->delimiter(',');
    app.add_option("--error", options.error, "RMSE wanted, of A and of the total");
    app.add_option("--memory", options.memory, "bytes (4G)")->transform(CLI::AsSizeValue(false));
    CLI11_PARSE(app, argument_count, arguments);
    heightlight::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "heightlight_bake_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
