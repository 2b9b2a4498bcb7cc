#include <fmt/core.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/compare_shading.h"
#include "cli/gloss_options.h"
#include "cli/name_errors.h"
#include "cli/number_list.h"
#include "cli/plots.h"
#include "cli/terminal_watch.h"
#include "cli/warnings.h"
#include "files/evidence_json.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "files/specular_table_file.h"
#include "files/staged_output.h"
#include "heightlight/error.h"
#include "heightlight/files.h"
#include "heightlight/version.h"
#include "plot/rendered_sheet.h"
#include "shading/shading_csv.h"
#include "shading/shading_report.h"

namespace heightlight {
namespace {

using nlohmann::ordered_json;

SpecularStudyOptions specular_options(const SpecularRun& run) {
  SpecularStudyOptions options{
      .memory = run.run.memory, .seed = run.run.seed, .watch = terminal_watch(run.run.quiet)};
  const std::string& text = run.specular.roughness;
  const std::optional<std::vector<double>> roughness = parse_number_list(text);
  if (!roughness) throw UsageError("roughness", text, "must be numbers above 0 and at most 1");
  options.roughness = *roughness;
  for (const double one : options.roughness) check_gloss({.roughness = one});
  for (const std::string& view : run.specular.views) options.views.push_back(parse_view(view));
  return options;
}

std::string specular_json(const SpecularRun& run, const LoadedHeightmap& loaded, const Surface& surface,
                          const SpecularStudy& study, const std::vector<FileRecord>& files) {
  ordered_json json;
  json["version"] = HEIGHTLIGHT_VERSION;
  json["map"] = describe_map(run.map.path, loaded.facts.sha256, surface);
  json["files"] = describe_files(files);
  json["warnings"] = describe_warnings(loaded.warnings);
  json["views_azimuth_elevation_degrees"] = run.specular.views;
  json["cone_cone_u_fitted"] = study.fitted_share;
  json["truth"] = ordered_json::array();
  for (const SpecularTruth& truth : study.truths)
    json["truth"].push_back({{"roughness", truth.roughness},
                             {"view", truth.view},
                             {"receivers", truth.seen},
                             {"narrow", truth.narrow},
                             {"mean", truth.mean},
                             {"rmse", truth.rmse}});
  json["nanoseconds_per_texel"] = ordered_json::object();
  for (const MethodTime& time : study.times) json["nanoseconds_per_texel"][time.method] = time.nanoseconds;
  return json_text(json);
}

/// A row for each roughness, the truth first. What the viewer does not see is blue.
void draw_specular(StagedFolder& folder, const SpecularStudy& study, const std::string& map_name,
                   double elevation, Plots& plots) {
  constexpr std::array<float, 3> kUnseen{0.33F, 0.45F, 0.62F};
  std::vector<RenderedForm> rendered;
  for (const SpecularPicture& picture : study.pictures) {
    rendered.push_back({.title = picture.method.empty() ? "truth" : picture.method,
                        .label = fmt::format("roughness {:g}", picture.roughness),
                        .rmse = picture.rmse,
                        .reflected = {picture.occlusion, picture.occlusion, picture.occlusion}});
    for (std::size_t c = 0; c < kUnseen.size(); ++c) {
      for (float& value : rendered.back().reflected.at(c).values) {
        if (std::isnan(value)) value = kUnseen.at(c);
      }
    }
  }
  std::size_t columns = 1;
  while (columns < rendered.size() && rendered[columns].title != "truth") ++columns;
  plots.draw(folder, {"specular.png"}, [&](const auto& paths) {
    plot_rendered(
        paths[0], rendered,
        {.title = fmt::format("{}, a window: specular occlusion from 0 (black) to 1, seen from {:.0f}° "
                              "above the plane; what is hidden from there is blue",
                              map_name, elevation),
         .quantity = "S",
         .columns = columns});
  });
}

void study_specular_on(const SpecularRun& run, const Surface& surface, LoadedHeightmap& loaded,
                       StagedFolder& folder, Plots& plots) {
  SpecularStudyOptions options = specular_options(run);
  for (const int side : {16, 32, 8})
    options.tables.push_back(
        {fmt::format("GTSO, table of {}^4", side), make_specular_table(side, options.watch)});
  if (!run.specular.table.empty())
    options.tables.push_back({"GTSO, table of --table", read_specular_table(run.specular.table)});
  const SpecularStudy study = study_specular(surface, options);
  const std::string name = printable(run.map.path.filename());
  write_specular_csv(folder.file("specular.csv"), study, options.views);
  write_specular_report(folder.file("specular.md"),
                        {.map_name = name, .surface = surface, .warnings = loaded.warnings}, study,
                        options.views);
  draw_specular(folder, study, name, elevation_deg(options.views[options.views.size() / 2]), plots);
  const std::vector<FileRecord> files = folder.written();
  write_bytes(folder.file("specular.json"), specular_json(run, loaded, surface, study, files));
  const std::vector<std::string> removed = folder.commit();
  tell_warnings(run.map.path, loaded.warnings);
  if (run.run.quiet) return;
  report_removed(removed);
  fmt::print("{}: {} lines in {}\n", printable(run.map.path), study.rows.size(),
             printable(run.folder / "specular.csv"));
}

}  // namespace

CLI::Option* add_specular_options(CLI::App& command, SpecularCompareOptions& options) {
  CLI::Option* specular =
      command.add_flag("--specular", options.wanted,
                       "compare instead the specular occlusion by AO, GTSO and other methods with rays");
  command
      .add_option("--roughness", options.roughness,
                  "values of roughness for --specular: alpha of GGX, each above 0 and at most 1 (default "
                  "0.02,0.13,0.4)")
      ->type_name("R,R…")
      ->needs(specular);
  command
      .add_option("--view", options.views,
                  "direction of view for --specular: azimuth clockwise from north and elevation above the "
                  "horizontal, in degrees; may be repeated (default 65,90 65,45 65,20)")
      ->type_name("AZIMUTH,ELEVATION")
      ->allow_extra_args(false)
      ->needs(specular);
  command
      .add_option("--table", options.table,
                  "table of GTSO made by specular-table, to compare as well with --specular")
      ->type_name("FILE.ktx")
      ->needs(specular);
  return specular;
}

void compare_specular(SpecularRun run) {
  apply_run_options(run.run);
  specular_options(run);  // refuses what it cannot read before anything is written
  StagedFolder folder(run.folder, {run.map.path, run.specular.table},
                      {"specular.csv", "specular.md", "specular.png", "specular.json"},
                      {.file = "specular.json"});
  Plots plots;
  LoadedHeightmap loaded = load_heightmap(run.map.path, run.map.load, run.run.memory);
  const Surface surface = build_surface(std::move(loaded.map));
  name_errors(run.map.path, [&] { study_specular_on(run, surface, loaded, folder, plots); });
  plots.check();
}

}  // namespace heightlight
