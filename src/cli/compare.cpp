#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <memory>

#include "base/byte_size.h"
#include "cli/albedo.h"
#include "cli/commands.h"
#include "cli/map_options.h"
#include "cli/name_errors.h"
#include "cli/plots.h"
#include "cli/terminal_watch.h"
#include "cli/warnings.h"
#include "comparison/comparison_csv.h"
#include "comparison/report.h"
#include "files/evidence_json.h"
#include "files/image_file.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "files/staged_output.h"
#include "heightlight/error.h"
#include "heightlight/files.h"
#include "heightlight/screenspace.h"
#include "heightlight/version.h"
#include "plot/error_pictures.h"
#include "plot/pareto_plot.h"

namespace heightlight {
namespace {

struct CompareOptions {
  MapOptions map;
  RunOptions run;
  std::filesystem::path folder;
  std::string albedo = "0.2,0.5,0.8";
  int azimuths = 128;
};

/// Albedos under the names that the table's quantities have.
std::vector<ComparedAlbedo> compared_albedos(const Albedo& albedo, const Surface& surface) {
  std::vector<ComparedAlbedo> albedos;
  for (const double constant : albedo.constant) {
    albedos.push_back({.label = fmt::format("{:g}", constant),
                       .reflectance = TexelVector(surface.map.height.size(), constant)});
  }
  constexpr std::array<const char*, 3> kChannels{"R", "G", "B"};
  for (std::size_t c = 0; c < albedo.varying.size(); ++c) {
    albedos.push_back({.label = albedo.varying.size() == 1 ? "map" : kChannels.at(c),
                       .reflectance = albedo.varying[c],
                       .varying = to_map(albedo.varying[c], surface)});
  }
  return albedos;
}

/// Bytes that the comparison holds beside what a method takes: the depth buffer, and per texel the surface,
/// the reference's maps, an estimate's, the albedos, and the differences that are drawn.
std::uint64_t bytes_held(const Surface& surface, std::size_t albedos, std::size_t shown) {
  constexpr std::uint64_t kMap = sizeof(Map::value_type);
  constexpr std::uint64_t kSurface = kMap + sizeof(Vector3);
  constexpr std::uint64_t kReference = 3 * kMap + sizeof(Vector3);
  constexpr std::uint64_t kEstimate = 4 * kMap + sizeof(Vector3);
  constexpr std::uint64_t kTwoTone = 3 * kMap + 3 * kMap;  // three channels of differences, and their sizes
  const std::uint64_t per_albedo = 2 * kMap + kMap + sizeof(TexelVector::value_type);
  const std::uint64_t per_texel =
      kSurface + kReference + kEstimate + kTwoTone + albedos * per_albedo + shown * kMap;
  return surface.map.height.size() * per_texel +
         depth_buffer_bytes(surface.width(), surface.height(), surface.map.boundary);
}

/// What a method may take: the limit less that.
std::uint64_t memory_for_methods(const CompareOptions& options, const Surface& surface,
                                 const std::vector<ComparedAlbedo>& albedos) {
  const std::uint64_t held = bytes_held(surface, albedos.size(), shown_methods().size());
  if (held < options.run.memory) return options.run.memory - held;
  throw MemoryError("comparing on " + std::to_string(surface.width()) + " × " +
                    std::to_string(surface.height()) + " texels needs " + format_byte_size(held) +
                    " beside what the methods take, more than the " + format_byte_size(options.run.memory) +
                    " allowed");
}

/// "error_03_gtao.png" of the number-th method that is drawn.
std::string error_picture_name(std::size_t number, std::string method) {
  std::replace(method.begin(), method.end(), ' ', '_');
  return fmt::format("error_{:02}_{}.png", number, method);
}

std::vector<std::string> result_names() {
  std::vector<std::string> names{"compare.csv", "compare.json", "report.md",
                                 "pareto.svg",  "pareto.png",   "errors.png"};
  const std::vector<std::string> shown = shown_methods();
  for (std::size_t i = 0; i < shown.size(); ++i) names.push_back(error_picture_name(i + 1, shown[i]));
  return names;
}

void write_error_pictures(StagedFolder& folder, const std::vector<ErrorMap>& maps, const std::string& title,
                          Plots& plots) {
  for (std::size_t i = 0; i < maps.size(); ++i) {
    write_png(folder.file(error_picture_name(i + 1, maps[i].method)),
              difference_picture(maps[i].differences));
  }
  plots.draw(folder, {"errors.png"}, [&](const auto& paths) { plot_error_sheet(paths[0], maps, title); });
}

/// compare.json: the map, what the reference errs by, and the evidence of its totals.
std::string evidence_json(const CompareOptions& options, const Surface& surface,
                          const LoadedHeightmap& loaded, const ComparisonReference& reference,
                          const std::vector<FileRecord>& files) {
  nlohmann::ordered_json json;
  json["version"] = HEIGHTLIGHT_VERSION;
  json["map"] = describe_map(options.map.path, loaded.facts.sha256, surface);
  json["files"] = describe_files(files);
  json["warnings"] = describe_warnings(loaded.warnings);
  json["reference"] = {{"azimuths", reference.azimuths},
                       {"checked",
                        {{"receivers", reference.checked},
                         {"azimuths", kCheckAzimuths},
                         {"sky_view_factor_rmse", reference.sky_rmse},
                         {"bent_normal_rmse_degrees", reference.bent_rmse_deg},
                         {"rays", kCheckRays},
                         {"sky_view_factor_rmse_by_rays", reference.ray_rmse}}}};
  json.update(describe_evidence(reference.total_evidence));
  json["time_s"] = describe_times(reference.total_evidence.seconds);
  json["memory"] = describe_memory(reference.total_evidence);
  json["threads"] = reference.total_evidence.threads;
  return json_text(json);
}

void compare_on(const CompareOptions& options, const Surface& surface, LoadedHeightmap& loaded,
                StagedFolder& folder, Plots& plots) {
  const Watch terminal = terminal_watch(options.run.quiet);
  const std::vector<ComparedAlbedo> albedos =
      compared_albedos(read_albedo(options.albedo, surface.map, options.run.memory).albedo, surface);
  const std::uint64_t memory = memory_for_methods(options, surface, albedos);
  const Stopwatch watch;
  const DepthBuffer depth = make_depth_buffer(surface);
  const Cost depth_cost = watch.elapsed();
  const ComparisonReference reference = build_reference(surface, {.azimuths = options.azimuths,
                                                                  .albedos = albedos,
                                                                  .memory = memory,
                                                                  .seed = options.run.seed,
                                                                  .watch = terminal});
  const ComparedScene scene{
      .surface = surface, .depth = depth, .albedos = albedos, .memory = memory, .seed = options.run.seed};
  const Comparison comparison = compare_methods(scene, reference, make_contenders(scene), terminal);

  for (const std::string& fault : find_faults(reference.total_evidence))
    loaded.warnings.push_back({"the reference: " + fault});
  const std::string name = printable(options.map.path.filename());
  write_comparison_csv(folder.file("compare.csv"), comparison.rows);
  write_report(folder.file("report.md"), {.map_name = name,
                                          .scene = scene,
                                          .reference = reference,
                                          .comparison = comparison,
                                          .depth_cost = depth_cost,
                                          .warnings = loaded.warnings});
  plots.draw(folder, {"pareto.svg", "pareto.png"}, [&](const auto& paths) {
    plot_pareto(paths[0], paths[1], comparison.rows, {kSkyQuantity, total_quantity(albedos.back())}, name);
  });
  write_error_pictures(folder, comparison.shown, name, plots);
  const std::vector<FileRecord> files = folder.written();
  write_bytes(folder.file("compare.json"), evidence_json(options, surface, loaded, reference, files));
  const std::vector<std::string> removed = folder.commit();
  tell_warnings(options.map.path, loaded.warnings);
  if (options.run.quiet) return;
  report_removed(removed);
  fmt::print("{}: {} lines in {}\n", printable(options.map.path), comparison.rows.size(),
             printable(options.folder / "compare.csv"));
}

void compare(CompareOptions& options) {
  apply_run_options(options.run);
  check_azimuths(options.azimuths);
  StagedFolder folder(options.folder, {options.map.path, options.albedo}, result_names(),
                      {.file = "compare.json", .prefix = "error_"});
  Plots plots;
  LoadedHeightmap loaded = load_heightmap(options.map.path, options.map.load, options.run.memory);
  const Surface surface = build_surface(std::move(loaded.map));
  name_errors(options.map.path, [&] { compare_on(options, surface, loaded, folder, plots); });
  plots.check();
}

}  // namespace

void add_compare_command(CLI::App& app) {
  auto* command = app.add_subcommand("compare", "Methods for AO and bounces: time against error");
  auto options = std::make_shared<CompareOptions>();
  add_map_options(*command, options->map);
  command->add_option("-o,--output", options->folder, "folder for the results")->type_name("DIR")->required();
  command
      ->add_option("--albedo", options->albedo,
                   "of the totals: one to three numbers, or an image of the map's size (0.2,0.5,0.8)")
      ->type_name("R|R,R,R|FILE");
  command->add_option("--azimuths", options->azimuths,
                      "of the reference, an even number (128); its error stands in the report");
  add_run_options(*command, options->run);
  command->footer(
      "Writes compare.csv, compare.json, report.md, pareto.svg and .png, errors.png, and "
      "error_NN_METHOD.png.\n"
      "Examples:\n"
      "  heightlight compare brick.png -o brick\n"
      "  heightlight compare dem.tif -o dem --texel 50 --boundary open --albedo 0.3");
  command->callback([options] { compare(*options); });
}

}  // namespace heightlight
