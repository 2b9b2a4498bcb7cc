#include "cli/compare_terrain.h"

#include <fmt/core.h>

#include <charconv>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/byte_size.h"
#include "cli/albedo.h"
#include "cli/light_options.h"
#include "cli/memory_promise.h"
#include "cli/name_errors.h"
#include "cli/plots.h"
#include "cli/terminal_watch.h"
#include "cli/warnings.h"
#include "files/evidence_json.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "files/staged_output.h"
#include "heightlight/error.h"
#include "heightlight/files.h"
#include "heightlight/version.h"
#include "plot/pareto_plot.h"
#include "terrain/terrain_csv.h"
#include "terrain/terrain_report.h"

namespace heightlight {
namespace {

using nlohmann::ordered_json;
using std::numbers::pi;

TrialOptions trial_options(const TerrainRun& run, const Surface& surface) {
  TrialOptions options{.sun = run.sun, .seed = run.run.seed, .watch = terminal_watch(run.run.quiet)};
  if (!run.albedo.empty()) {
    const std::optional<std::vector<double>> albedos = parse_albedo_list(run.albedo);
    if (!albedos) throw UsageError("albedo", run.albedo, "must be one to eight numbers with --terrain");
    options.albedos = *albedos;
  }
  const std::uint64_t held = surface.map.height.size() * study_bytes_per_texel(options.albedos.size());
  if (held >= run.run.memory)
    throw MemoryError("the study needs " + format_byte_size(held) +
                          " beside the light transport, more than the " + format_byte_size(run.run.memory) +
                          " allowed",
                      held + 1 - run.run.memory);
  options.memory = run.run.memory - held;
  return options;
}

ordered_json describe_trial(const TerrainStudy& study) {
  ordered_json lights = ordered_json::array();
  for (const TrialLight& light : study.trial.lights) {
    ordered_json one{{"light", light.name}, {"level", light.level}, {"mean_direct", light.mean_direct}};
    one.update(describe_evidence(light.evidence));
    one["time_s"] = describe_times(light.evidence.seconds);
    lights.push_back(std::move(one));
  }
  return lights;
}

std::string terrain_json(const TerrainRun& run, const LoadedHeightmap& loaded,
                         const TerrainReportInput& input, const std::vector<FileRecord>& files) {
  const TerrainStudy& study = input.study;
  const Evidence& evidence = study.trial.lights.front().evidence;
  ordered_json json;
  json["version"] = HEIGHTLIGHT_VERSION;
  json["map"] = describe_map(run.map.path, loaded.facts.sha256, input.surface);
  json["files"] = describe_files(files);
  json["warnings"] = describe_warnings(loaded.warnings);
  json["sun"] = {{"azimuth_degrees_from_north", 90 - run.sun.azimuth_rad * 180 / pi},
                 {"elevation_degrees", run.sun.elevation_rad * 180 / pi},
                 {"diameter_degrees", run.sun.diameter_rad * 180 / pi},
                 {"core_seconds", study.trial.sun_cost.core}};
  json["albedos"] = study.options.albedos;
  json["sky"] = {{"mean_sky_view_factor", study.trial.mean_sky},
                 {"mean_dark_below_horizontal", study.trial.mean_upper_sky},
                 {"expected_seen", study.trial.expected_seen},
                 {"deep_seen", study.trial.deep_seen}};
  json["truth"] = describe_trial(study);
  json["methods"] = {{"receivers", study.receivers}, {"azimuths_of_truth", kTruthAzimuths}};
  json["memory"] = describe_memory(evidence);
  json["threads"] = evidence.threads;
  return json_text(json);
}

/// As the plot of methods wants them.
std::vector<ComparisonRow> plotted_rows(const std::vector<TerrainMethodRow>& rows) {
  std::vector<ComparisonRow> plotted;
  for (const TerrainMethodRow& row : rows) {
    plotted.push_back({.method = row.method,
                       .parameters = parameters_of(row),
                       .quantity = name_of(row.quantity),
                       .cost = row.cost,
                       .error = {.rmse = row.error.rmse, .bias = row.error.bias}});
  }
  return plotted;
}

void draw_methods(StagedFolder& folder, const TerrainReportInput& input, Plots& plots) {
  std::vector<ParetoPanel> panels;
  for (const TerrainQuantity& quantity : terrain_quantities())
    panels.push_back({.quantity = name_of(quantity)});
  plots.draw(folder, {"terrain_methods.svg", "terrain_methods.png"}, [&](const auto& paths) {
    plot_pareto(paths[0], paths[1], plotted_rows(input.study.methods), panels, input.map_name);
  });
}

void study_on(const TerrainRun& run, const Surface& surface, LoadedHeightmap& loaded, StagedFolder& folder,
              Plots& plots) {
  const TerrainStudy study = study_terrain(surface, trial_options(run, surface));
  for (const TrialLight& light : study.trial.lights) {
    for (const std::string& fault : find_faults(light.evidence))
      loaded.warnings.push_back({"the truth under the " + light.name + ": " + fault});
  }
  const TerrainReportInput input{.map_name = printable(run.map.path.filename()),
                                 .surface = surface,
                                 .study = study,
                                 .warnings = loaded.warnings};
  write_terrain_forms_csv(folder.file("terrain_forms.csv"), study.trial.rows);
  write_terrain_methods_csv(folder.file("terrain_methods.csv"), study.methods);
  write_terrain_report(folder.file("terrain.md"), input);
  draw_methods(folder, input, plots);
  const std::vector<FileRecord> files = folder.written();
  write_bytes(folder.file("terrain.json"), terrain_json(run, loaded, input, files));
  const std::vector<std::string> removed = folder.commit();
  tell_warnings(run.map.path, loaded.warnings);
  if (run.run.quiet) return;
  report_removed(removed);
  fmt::print("{}: {} formulas' and {} methods' lines in {}\n", printable(run.map.path),
             study.trial.rows.size(), study.methods.size(), printable(run.folder));
}

}  // namespace

CLI::Option* add_terrain_options(CLI::App& command, TerrainOptions& options) {
  options.sun = parse_sun("135,30");
  CLI::Option* terrain =
      command.add_flag("--terrain", options.wanted,
                       "compare instead the formulas that energy balances use for reflected light of "
                       "terrain, and the usual algorithms for sky view factors");
  command
      .add_option_function<std::string>(
          "--sun", [&options](const std::string& text) { options.sun = parse_sun(text); },
          "position of the sun for --terrain: degrees clockwise from north and degrees above the horizontal "
          "(default 135,30)")
      ->type_name("AZIMUTH,ELEVATION")
      ->needs(terrain);
  return terrain;
}

void compare_terrain(TerrainRun run) {
  apply_run_options(run.run);
  StagedFolder folder(run.folder, {run.map.path},
                      {"terrain_forms.csv", "terrain_methods.csv", "terrain.md", "terrain_methods.svg",
                       "terrain_methods.png", "terrain.json"},
                      {.file = "terrain.json"});
  Plots plots;
  keep_promise(run.run, [&] {
    LoadedHeightmap loaded = load_heightmap(run.map.path, run.map.load, run.run.memory);
    const Surface surface = build_surface(std::move(loaded.map));
    name_errors(run.map.path, [&] { study_on(run, surface, loaded, folder, plots); });
  });
  plots.check();
}

}  // namespace heightlight
