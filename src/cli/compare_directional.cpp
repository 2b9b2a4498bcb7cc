#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "cli/compare_shading.h"
#include "cli/name_errors.h"
#include "cli/plots.h"
#include "cli/terminal_watch.h"
#include "cli/warnings.h"
#include "comparison/sky_comparison.h"
#include "files/evidence_json.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "files/staged_output.h"
#include "heightlight/files.h"
#include "heightlight/version.h"
#include "plot/rendered_sheet.h"
#include "shading/shading_csv.h"
#include "shading/shading_report.h"

namespace heightlight {
namespace {

using nlohmann::ordered_json;

std::string directional_json(const DirectionalRun& run, const LoadedHeightmap& loaded, const Surface& surface,
                             const DirectionalStudy& study, const std::vector<FileRecord>& files) {
  ordered_json json;
  json["version"] = HEIGHTLIGHT_VERSION;
  json["map"] = describe_map(run.map.path, loaded.facts.sha256, surface);
  json["files"] = describe_files(files);
  json["warnings"] = describe_warnings(loaded.warnings);
  json["receivers"] = study.grid.texels.size();
  json["azimuths_of_truth"] = kOpennessAzimuths;
  json["costs"] = ordered_json::array();
  for (const ShadingCost& cost : study.costs) {
    ordered_json one{{"method", cost.method}, {"nanoseconds", cost.nanoseconds}, {"look_ups", cost.lookups}};
    if (cost.lookups == 0) {
      one["arithmetic"] = cost.arithmetic;
      one["roots"] = cost.functions;
    }
    json["costs"].push_back(std::move(one));
  }
  return json_text(json);
}

/// Red, green and blue, as bright as pictures of light under skies are.
std::array<Map, 3> exposed_channels(const Image<Vector3>& light) {
  std::array<Map, 3> channels{Map(light.width, light.height), Map(light.width, light.height),
                              Map(light.width, light.height)};
  for (std::size_t i = 0; i < light.size(); ++i) {
    channels[0].values[i] = kSkyExposure * light.values[i].x;
    channels[1].values[i] = kSkyExposure * light.values[i].y;
    channels[2].values[i] = kSkyExposure * light.values[i].z;
  }
  return channels;
}

void draw_directional(StagedFolder& folder, const DirectionalStudy& study, const std::string& map_name,
                      Plots& plots) {
  std::vector<RenderedForm> rendered;
  for (const ShadedPicture& picture : study.pictures) {
    rendered.push_back({.title = picture.method.empty() ? "truth" : picture.method,
                        .label = picture.method.empty()
                                     ? picture.sky
                                     : fmt::format("{}, MRSE {:.5f}", picture.sky, picture.mrse),
                        .reflected = exposed_channels(picture.light)});
  }
  std::size_t columns = 1;
  while (columns < rendered.size() && rendered[columns].title != "truth") ++columns;
  plots.draw(folder, {"directional.png"}, [&](const auto& paths) {
    plot_rendered(
        paths[0], rendered,
        {.title = fmt::format("{}, a window: direct irradiance of skies, E/π, of which {:g} is shown",
                              map_name, kSkyExposure),
         .columns = columns});
  });
}

void study_directional_on(const DirectionalRun& run, const Surface& surface, LoadedHeightmap& loaded,
                          StagedFolder& folder, Plots& plots) {
  DirectionalStudyOptions options{
      .memory = run.run.memory, .seed = run.run.seed, .watch = terminal_watch(run.run.quiet)};
  if (!run.sky.empty())
    options.skies.push_back(
        {printable(run.sky.filename()), normalised(load_sky_light(run.sky, run.run.memory))});
  const DirectionalStudy study = study_directional(surface, options);
  const std::string name = printable(run.map.path.filename());
  write_directional_csv(folder.file("directional.csv"), study);
  write_cone_forms_csv(folder.file("cone_forms.csv"), study.forms);
  write_directional_report(folder.file("directional.md"),
                           {.map_name = name, .surface = surface, .warnings = loaded.warnings}, study);
  draw_directional(folder, study, name, plots);
  const std::vector<FileRecord> files = folder.written();
  write_bytes(folder.file("directional.json"), directional_json(run, loaded, surface, study, files));
  const std::vector<std::string> removed = folder.commit();
  tell_warnings(run.map.path, loaded.warnings);
  if (run.run.quiet) return;
  report_removed(removed);
  fmt::print("{}: {} lines in {}\n", printable(run.map.path), study.rows.size(),
             printable(run.folder / "directional.csv"));
}

}  // namespace

CLI::Option* add_directional_option(CLI::App& command, bool& wanted) {
  return command.add_flag("--directional", wanted,
                          "compare instead the diffuse light of uneven skies by AO, bent normals, harmonics "
                          "and directional GTAO with exact horizons; --sky adds one more sky");
}

void compare_directional(DirectionalRun run) {
  apply_run_options(run.run);
  StagedFolder folder(
      run.folder, {run.map.path, run.sky},
      {"directional.csv", "cone_forms.csv", "directional.md", "directional.png", "directional.json"},
      {.file = "directional.json"});
  Plots plots;
  LoadedHeightmap loaded = load_heightmap(run.map.path, run.map.load, run.run.memory);
  const Surface surface = build_surface(std::move(loaded.map));
  name_errors(run.map.path, [&] { study_directional_on(run, surface, loaded, folder, plots); });
  plots.check();
}

}  // namespace heightlight
