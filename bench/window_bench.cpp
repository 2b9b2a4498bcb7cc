// The error of a window of a map against the whole map, by the size of the halo in which the window finds its
// irradiance: RMS of A and of the total at an albedo of 0.8 inside a window of 256 × 256 texels, or of a
// third of a small map's sides. Both are walked by the window's own plan, so that the error is due only to
// what the window does not know about the rest of the map.
#include <OpenImageIO/imageio.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "heightlight/error.h"
#include "heightlight/solve.h"
#include "windows/bake_window.h"
#include "windows/begin_work.h"
#include "windows/step_plan.h"
#include "windows/steps.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;

constexpr double kAlbedo = 0.8;
constexpr int kWindowSide = 256;

struct BenchOptions {
  fs::path map;
  fs::path scratch = fs::temp_directory_path() / "heightlight-window-bench";
  std::optional<double> relief;
  std::optional<double> texel;
  bool tiles = false;
  double error = 0.002;
};

WindowedTask task_of(const BenchOptions& options) {
  WindowedTask task{.map = options.map};
  task.load = {.relief = options.relief, .boundary = options.tiles ? Boundary::tile : Boundary::open};
  if (options.texel) task.load.texel = Spacing{*options.texel, *options.texel};
  task.options.maps = {MaterialMap::ao, MaterialMap::multibounce};
  task.options.albedo = {.constant = {kAlbedo}};
  task.options.error = options.error;
  task.options.format = TextureFormat::tif;
  task.options.depth = TextureDepth::real;
  task.folder = options.scratch / "work";
  return task;
}

/// A and the total of the whole map, found by the given plan.
Results solve_whole(const WindowedTask& task, const HorizonPlan& plan) {
  const Surface surface = build_surface(load_heightmap(task.map, task.load, ~0ULL).map);
  Results results = solve(surface, {.wanted = {.sky = true, .totals = {task.options.albedo}},
                                    .accuracy = {.error = task.options.error, .plan = plan},
                                    .checks = {.sky = false, .totals = false}});
  return results;
}

Map read_map(const fs::path& path) {
  const auto file = OIIO::ImageInput::open(path.string());
  if (!file) throw Error(path.string() + ": cannot be read");
  Map map(file->spec().width, file->spec().height);
  file->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, map.values.data());
  return map;
}

template <class Value>
double rms_inside(const Map& window, const MapRect& rect, Value&& whole) {
  double squares = 0;
  std::size_t present = 0;
  for (int i = 0; i < rect.rows; ++i) {
    for (int j = 0; j < rect.columns; ++j) {
      const double difference = double{window(i, j)} - whole(rect.first_row + i, rect.first_column + j);
      if (std::isnan(difference)) continue;
      squares += difference * difference;
      ++present;
    }
  }
  return std::sqrt(squares / static_cast<double>(present));
}

void compare_window(WindowedTask task, const MapRect& window, const char* where) {
  Work work = begin_work(task, 0);
  for (int part = 0; part < work.state.facts.grid.count(); ++part) find_coarse_blocks(work, part);
  const HorizonPlan plan = plan_on(work, middle_crop(window, work.state.facts.grid));
  const Results whole = solve_whole(task, plan);
  const auto width = static_cast<std::size_t>(whole.sky_view_factor.width);
  for (const int halo : {0, 32, 64, 128, 256, 512}) {
    task.halo = halo;
    const fs::path folder = task.folder.parent_path() / "window";
    bake_window(task, window, {.source = task.map, .inputs = {}, .folder = folder, .name = "window"});
    const double sky = rms_inside(read_map(folder / "window_ao.tif"), window, [&](int row, int column) {
      return double{whole.sky_view_factor(row, column)};
    });
    const double total =
        rms_inside(read_map(folder / "window_multibounce.tif"), window, [&](int row, int column) {
          return whole.totals[0][0][static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column)];
        });
    std::printf("%s,%s,%d,%.2g,%.2g,%.2g\n", task.map.stem().c_str(), where, halo, sky, total,
                total / task.options.error);
    std::fflush(stdout);
  }
}

void run(const BenchOptions& options) {
  fs::create_directories(options.scratch);
  const WindowedTask task = task_of(options);
  const Heightmap map = load_heightmap(task.map, task.load, ~0ULL).map;
  const int rows = std::min(kWindowSide, map.height.height / 3);
  const int columns = std::min(kWindowSide, map.height.width / 3);
  std::puts("map,window,halo,ao_rms,total_rms,total_rms_over_error");
  compare_window(task, {(map.height.height - rows) / 2, (map.height.width - columns) / 2, rows, columns},
                 "middle");
  compare_window(task, {0, 0, rows, columns}, "corner");
  fs::remove_all(options.scratch);
}

}  // namespace
}  // namespace heightlight

int main(int argc, char** argv) {
  using namespace heightlight;
  CLI::App app{"What windows of a map err by, by the halo around them"};
  BenchOptions options;
  app.add_option("MAP", options.map)->required();
  app.add_option("--relief", options.relief);
  app.add_option("--texel", options.texel);
  app.add_flag("--tiles", options.tiles);
  app.add_option("--error", options.error);
  CLI11_PARSE(app, argc, argv);
  try {
    run(options);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
