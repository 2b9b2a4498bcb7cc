#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "cli/commands.h"
#include "cli/json_line.h"
#include "cli/map_options.h"
#include "cli/memory_promise.h"
#include "cli/request.h"
#include "cli/warnings.h"
#include "files/evidence_json.h"
#include "files/printable.h"

namespace heightlight {
namespace {

void report_file(const std::filesystem::path& path, const SourceFacts& facts) {
  fmt::print("file       {}\n", printable(path));
  if (facts.bits > 0) {
    fmt::print("format     {}, {} ({} bits per sample)\n", facts.format, facts.sample_type, facts.bits);
  } else {
    fmt::print("format     {}\n", facts.format);
  }
  fmt::print("channel    {} (of {})\n", printable(facts.channel), facts.channels);
  fmt::print("stored     {:.9g} to {:.9g}, {}{} distinct levels{}\n", facts.lowest, facts.highest,
             facts.levels > kMostLevels ? "more than " : "", std::min(facts.levels, kMostLevels),
             facts.is_stretched ? " (without unit; stretched to the relief)" : "");
  if (facts.white_is_zero) fmt::print("white is 0  larger numbers are darker, and lower\n");
  if (facts.declared_no_data)
    fmt::print("no-data    {:.9g}, {}\n", *facts.declared_no_data,
               facts.no_data_assumed ? "the default of such grids" : "according to the file");
  fmt::print("sha256     {}\n", facts.sha256);
}

/// Where it lies, as far as the file says it.
void report_place(const Georeference& place) {
  if (place.corner) {
    fmt::print("place      upper left corner at {:.12g}, {:.12g}{}\n", (*place.corner)[0], (*place.corner)[1],
               place.system.empty() ? "" : " in " + printable(place.system));
  } else {
    fmt::print("place      not given\n");
  }
  if (place.height_metres) fmt::print("heights in units of {:.9g} m\n", *place.height_metres);
}

/// Whether it is terrain or a material, and why: what `bake` takes it for.
void report_kind(const LoadedHeightmap& loaded, const LoadOptions& options) {
  if (options.boundary == Boundary::tile) {
    fmt::print("kind       material: the map tiles\n");
  } else if (!loaded.place && options.texel && options.boundary == Boundary::open) {
    fmt::print("kind       terrain: a distance between samples and open edges are given\n");
  } else if (!loaded.place) {
    fmt::print("kind       material: its file gives no distance between samples\n");
  }
  if (!loaded.place) return;
  const Georeference& place = *loaded.place;
  const std::string unit = place.in_degrees ? " degrees"
                           : !place.metres
                               ? ", in a unit that the file does not name; it is taken as that of the heights"
                           : *place.metres == 1.0 ? " m"
                                                  : fmt::format(" units of {:.9g} m", *place.metres);
  const std::string distance = fmt::format("its file gives the distance between samples, {:.9g} x {:.9g}{}",
                                           place.cell.x, place.cell.y, unit);
  if (options.boundary == Boundary::tile) {
    fmt::print("           {}\n", distance);
  } else {
    fmt::print("kind       terrain: {}\n", distance);
  }
  report_place(place);
}

void report_map(const Heightmap& map, const EdgeSteps& steps) {
  const int columns = map.height.width;
  const int rows = map.height.height;
  const double tall = relief(map);
  fmt::print("size       {} x {} samples\n", columns, rows);
  fmt::print("spacing    {:.6g} x {:.6g}\n", map.spacing.x, map.spacing.y);
  fmt::print("extent     {:.6g} x {:.6g}\n", columns * map.spacing.x, rows * map.spacing.y);
  fmt::print("heights    {:.7g} to {:.7g}\n", map.base, map.base + tall);
  fmt::print("relief     {:.6g} ({:.3g} of the width)\n", tall, tall / (columns * map.spacing.x));
  fmt::print("boundary   {}\n", to_string(map.boundary));
  if (std::isnan(steps.across_x) && std::isnan(steps.across_y)) {
    fmt::print("edges      no samples to compare\n");
  } else {
    fmt::print(
        "edges      {}; steps (rms) across, beside and inside: x {:.3g}, {:.3g}, {:.3g}, y {:.3g}, {:.3g}, "
        "{:.3g}\n",
        steps.wraps ? "wrap" : "do not wrap", steps.across_x, steps.beside_x, steps.inside_x, steps.across_y,
        steps.beside_y, steps.inside_y);
  }
  const std::size_t missing = count_missing(map);
  const double percent = 100 * static_cast<double>(missing) / static_cast<double>(map.height.size());
  fmt::print("missing    {} of {} samples ({:.2f} %)\n", missing, map.height.size(), percent);
}

/// Whether `bake` takes it for terrain.
bool is_terrain(const LoadedHeightmap& loaded, const LoadOptions& options) {
  if (options.boundary == Boundary::tile) return false;
  return loaded.place || (options.texel && options.boundary == Boundary::open);
}

nlohmann::ordered_json describe_file(const SourceFacts& facts) {
  return {{"format", facts.format},
          {"sample_type", facts.sample_type},
          {"bits", facts.bits},
          {"channel", facts.channel},
          {"channels", facts.channels},
          {"lowest", facts.lowest},
          {"highest", facts.highest},
          {"levels", std::min(facts.levels, kMostLevels)},
          {"more_levels", facts.levels > kMostLevels},
          {"is_stretched", facts.is_stretched},
          {"white_is_zero", facts.white_is_zero},
          {"no_data", or_null(facts.declared_no_data)}};
}

nlohmann::ordered_json describe_edges(const EdgeSteps& steps) {
  return {{"wrap", steps.wraps},
          {"steps_rms_across_beside_inside",
           {{"x", {steps.across_x, steps.beside_x, steps.inside_x}},
            {"y", {steps.across_y, steps.beside_y, steps.inside_y}}}}};
}

nlohmann::ordered_json describe_place(const Georeference& place) {
  return {{"cell", {place.cell.x, place.cell.y}},
          {"in_degrees", place.in_degrees},
          {"metres", or_null(place.metres)},
          {"upper_left", or_null(place.corner)},
          {"system", place.system},
          {"height_metres", or_null(place.height_metres)}};
}

void print_json(const std::filesystem::path& path, const LoadedHeightmap& loaded,
                const LoadOptions& options) {
  nlohmann::ordered_json json;
  json["map"] = describe_map(path, loaded.facts.sha256, loaded.map,
                             {.relief = relief(loaded.map), .missing = count_missing(loaded.map)});
  json["file"] = describe_file(loaded.facts);
  json["kind"] = is_terrain(loaded, options) ? "terrain" : "material";
  json["place"] = loaded.place ? describe_place(*loaded.place) : nlohmann::ordered_json();
  json["lowest"] = loaded.map.base;
  json["edges"] = describe_edges(measure_edge_steps(loaded.map.height));
  json["warnings"] = warning_texts(loaded.warnings);
  print_json_line(json);
}

void run_info(MapOptions& map_options, RunOptions& run_options, bool json) {
  apply_run_options(run_options);
  const LoadedHeightmap loaded = keep_promise(
      run_options, [&] { return load_heightmap(map_options.path, map_options.load, run_options.memory); });
  if (json) return print_json(map_options.path, loaded, map_options.load);
  if (run_options.quiet) return;
  report_file(map_options.path, loaded.facts);
  report_kind(loaded, map_options.load);
  report_map(loaded.map, measure_edge_steps(loaded.map.height));
  for (const Warning& warning : loaded.warnings)
    fmt::print("warning    {}\n", printable(user_message(warning)));
}

}  // namespace

void add_info_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("info", "Show what a heightmap file holds and how it is interpreted");
  auto map_options = std::make_shared<MapOptions>();
  auto run_options = std::make_shared<RunOptions>();
  add_map_options(*command, *map_options);
  add_run_options(*command, *run_options);
  auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "print everything as one line of JSON");
  command->footer(
      "Lengths and heights are in the world unit of the map. Edges count as wrapping if the height steps "
      "across them are\n"
      "like those beside the edges or inside the map.\n"
      "Examples:\n"
      "  heightlight info bricks.png\n"
      "  heightlight info bricks.png --width 2 --relief 0.05\n"
      "  heightlight info dem.tif                                what its tags say, and whether it is "
      "terrain\n"
      "  heightlight info scan.tif --texel 50 --boundary open --no-data -9999\n"
      "  heightlight info scan.exr --channel Z");
  command->callback([map_options, run_options, json] { run_info(*map_options, *run_options, *json); });
}

}  // namespace heightlight
