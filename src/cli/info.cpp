#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "cli/commands.h"
#include "cli/map_options.h"

namespace heightlight {
namespace {

void report_file(const std::filesystem::path& path, const SourceFacts& facts) {
  std::printf("file       %s\n", path.c_str());
  if (facts.bits > 0) {
    std::printf("format     %s, %s (%d bits per sample)\n", facts.format.c_str(), facts.sample_type.c_str(),
                facts.bits);
  } else {
    std::printf("format     %s\n", facts.format.c_str());
  }
  std::printf("channel    %s (of %d)\n", facts.channel.c_str(), facts.channels);
  std::printf("stored     %.9g to %.9g, %s%zu distinct levels%s\n", facts.lowest, facts.highest,
              facts.levels > kMostLevels ? "more than " : "", std::min(facts.levels, kMostLevels),
              facts.is_integer ? " (without unit; stretched to the relief)" : "");
  if (facts.declared_no_data) std::printf("no-data    %.9g, says the file\n", *facts.declared_no_data);
  std::printf("sha256     %s\n", facts.sha256.c_str());
}

void report_map(const Heightmap& map, const EdgeSteps& steps) {
  const int columns = map.height.width;
  const int rows = map.height.height;
  const double tall = relief(map);
  std::printf("size       %d x %d samples\n", columns, rows);
  std::printf("spacing    %.6g x %.6g\n", map.spacing.x, map.spacing.y);
  std::printf("extent     %.6g x %.6g\n", columns * map.spacing.x, rows * map.spacing.y);
  std::printf("heights    %.7g to %.7g\n", map.base, map.base + tall);
  std::printf("relief     %.6g (%.3g of the width)\n", tall, tall / (columns * map.spacing.x));
  std::printf("boundary   %s\n", to_string(map.boundary));
  if (std::isnan(steps.across_x) && std::isnan(steps.across_y)) {
    std::printf("edges      no samples to compare\n");
  } else {
    std::printf("edges      %s; steps (rms) across and inside: x %.3g and %.3g, y %.3g and %.3g\n",
                steps.wraps ? "wrap" : "do not wrap", steps.across_x, steps.inside_x, steps.across_y,
                steps.inside_y);
  }
  const std::size_t missing = count_missing(map);
  const double percent = 100 * static_cast<double>(missing) / static_cast<double>(map.height.size());
  std::printf("missing    %zu of %zu samples (%.2f %%)\n", missing, map.height.size(), percent);
}

/// Values that programs write for missing samples, and that no relief on Earth has.
bool is_usual_no_data(double stored) {
  return stored == -9999 || stored == -99999 || stored == -32768 || stored == -32767 || stored < -3e38;
}

void report_warnings(const LoadedHeightmap& loaded, const EdgeSteps& steps) {
  constexpr std::size_t kFewLevels = 1024;
  const SourceFacts& facts = loaded.facts;
  const Heightmap& map = loaded.map;
  const double tall = relief(map);
  const double extent = std::max(map.height.width * map.spacing.x, map.height.height * map.spacing.y);
  if (tall == 0) std::printf("warning    the map is level: it has no relief\n");
  if (is_usual_no_data(facts.lowest)) {
    std::printf("warning    the lowest value stands for missing samples in many files: --no-data %.9g\n",
                facts.lowest);
  }
  if (facts.is_integer && facts.levels > 1 && facts.levels <= kFewLevels) {
    std::printf("warning    %zu of %.0f levels are in use: slopes are terraces, about %.2g high\n",
                facts.levels, std::ldexp(1, facts.bits), tall / static_cast<double>(facts.levels - 1));
  }
  if (map.boundary == Boundary::tile && !steps.wraps) {
    std::printf(
        "warning    the map is to tile, but its edges do not meet; --boundary open if it stands alone\n");
  }
  if (tall > extent) {
    std::printf(
        "warning    the relief is %.3g times the extent; if the spacing is not right, give it with --texel\n",
        tall / extent);
  }
}

void run_info(MapOptions& map_options, RunOptions& run_options) {
  apply_run_options(run_options);
  const LoadedHeightmap loaded = load_heightmap(map_options.path, map_options.load, run_options.memory);
  if (run_options.quiet) return;
  const EdgeSteps steps = measure_edge_steps(loaded.map.height);
  report_file(map_options.path, loaded.facts);
  report_map(loaded.map, steps);
  report_warnings(loaded, steps);
}

}  // namespace

void add_info_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("info", "Say what a heightmap file holds and how it is understood");
  auto map_options = std::make_shared<MapOptions>();
  auto run_options = std::make_shared<RunOptions>();
  add_map_options(*command, *map_options);
  add_run_options(*command, *run_options);
  command->footer(
      "Lengths and heights are in the map's world unit. Edges wrap when steps across them are like those "
      "inside.\n"
      "Examples:\n"
      "  heightlight info bricks.png\n"
      "  heightlight info bricks.png --width 2 --relief 0.05\n"
      "  heightlight info dem.tif --texel 50 --boundary open --no-data -9999\n"
      "  heightlight info scan.exr --channel Z");
  command->callback([map_options, run_options] { run_info(*map_options, *run_options); });
}

}  // namespace heightlight
