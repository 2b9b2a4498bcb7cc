#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <memory>

#include "base/byte_size.h"
#include "base/stopwatch.h"
#include "cli/albedo.h"
#include "cli/commands.h"
#include "cli/compare_json.h"
#include "cli/compare_pictures.h"
#include "cli/compare_report.h"
#include "cli/compare_shading.h"
#include "cli/compare_terrain.h"
#include "cli/map_options.h"
#include "cli/memory_promise.h"
#include "cli/name_errors.h"
#include "cli/plots.h"
#include "cli/report_facts.h"
#include "cli/terminal_watch.h"
#include "cli/user_form_options.h"
#include "cli/warnings.h"
#include "comparison/comparison_csv.h"
#include "comparison/comparison_study.h"
#include "comparison/report.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "files/staged_output.h"
#include "heightlight/error.h"
#include "heightlight/files.h"
#include "heightlight/screenspace.h"
#include "heightlight/shaders.h"

namespace heightlight {
namespace {

struct CompareOptions {
  MapOptions map;
  RunOptions run;
  std::filesystem::path folder;
  std::string albedo = "0.2,0.5,0.8";
  UserFormOptions forms;
  std::filesystem::path sky;
  int azimuths = 128;
  TerrainOptions terrain;
  SpecularCompareOptions specular;
  bool directional = false;
  bool report = false;
};

/// Albedos under the names that the table's quantities have: numbers one by one, or what an image holds.
std::vector<ComparedAlbedo> compared_albedos(const CompareOptions& options, const Surface& surface) {
  std::vector<ComparedAlbedo> albedos;
  const std::optional<std::vector<double>> list = parse_albedo_list(options.albedo);
  const Albedo albedo = list ? Albedo{.constant = *list, .varying = {}}
                             : read_albedo(options.albedo, surface.map, options.run.memory).albedo;
  constexpr std::array<const char*, 3> kChannels{"R", "G", "B"};
  const bool is_colour = !list && albedo.constant.size() == kChannels.size();  // #RRGGBB
  for (std::size_t c = 0; c < albedo.constant.size(); ++c) {
    albedos.push_back({.label = is_colour ? kChannels.at(c) : fmt::format("{:g}", albedo.constant[c]),
                       .reflectance = TexelVector(surface.map.height.size(), albedo.constant[c])});
  }
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
  constexpr std::uint64_t kReference = 4 * kMap + 2 * sizeof(Vector3);
  constexpr std::uint64_t kEstimate = 3 * kMap + sizeof(Vector3);
  constexpr std::uint64_t kSky = sizeof(Vector3) + 3 * kMap + 3 * kMap;  // light, differences, their sizes
  constexpr std::uint64_t kPanels = sizeof(std::size_t);                 // texels sorted by AO
  const std::uint64_t per_albedo = 2 * kMap + kMap + sizeof(TexelVector::value_type);
  const std::uint64_t per_texel =
      kSurface + kReference + kEstimate + kSky + kPanels + albedos * per_albedo + shown * kMap;
  return surface.map.height.size() * per_texel +
         depth_buffer_bytes(surface.width(), surface.height(), surface.map.boundary);
}

/// What a method may take: the limit less that.
std::uint64_t memory_for_methods(const CompareOptions& options, const Surface& surface,
                                 const std::vector<ComparedAlbedo>& albedos) {
  const std::uint64_t held = bytes_held(surface, albedos.size(), shown_methods().size()) +
                             (options.report ? comparison_report_bytes(surface, albedos.size()) : 0);
  if (held < options.run.memory) return options.run.memory - held;
  throw MemoryError("comparing on " + std::to_string(surface.width()) + " × " +
                        std::to_string(surface.height()) + " texels needs " + format_byte_size(held) +
                        " beside what the methods take, more than the " +
                        format_byte_size(options.run.memory) + " allowed",
                    held + 1 - options.run.memory);
}

std::vector<std::string> result_names() {
  std::vector<std::string> names{"compare.csv",      "compare.json", "report.md",     "forms.svg",
                                 "forms.png",        "pareto.svg",   "pareto.png",    "errors.png",
                                 "total_errors.png", "showtime.png", "sky_light.png", "directions.png",
                                 "forms.glsl",       "forms.hlsl",   kReportFile};
  const std::vector<std::string> shown = shown_methods();
  for (std::size_t i = 0; i < shown.size(); ++i) names.push_back(error_picture_name(i + 1, shown[i]));
  return names;
}

/// The user's sky, or that of two tones.
ComparedSky read_compared_sky(const CompareOptions& options) {
  if (options.sky.empty()) return {};
  return {.quantity = "sky_irradiance",
          .label = "the sky " + printable(options.sky.filename()),
          .light = normalised(load_sky_light(options.sky, options.run.memory))};
}

/// The forms of the list as published, then the user's as fitted to the map.
std::string shader_of_forms(const std::vector<FormOnMap>& own_forms, ShaderLanguage language) {
  std::vector<ShaderFunction> functions;
  for (const FormOnMap& own : own_forms) {
    for (ShaderFunction& function : user_form_functions(own.form, own.constants))
      functions.push_back(std::move(function));
  }
  return shader_text(language, {}, functions);
}

/// Where the user's forms say nothing on exact AO, which a table alone would tell too softly.
std::vector<std::string> find_poles(const std::vector<FormOnMap>& own_forms, const Answer& answer) {
  std::vector<std::string> faults;
  for (const FormOnMap& own : own_forms) {
    for (const AnswerLine& line : answer.groups.front().lines) {
      if (line.form == own.form.name && line.outside_share > 0)
        faults.push_back(fmt::format("form {} has no finite value on {:.2g} % of the texels", line.form,
                                     100 * line.outside_share));
    }
  }
  return faults;
}

void compare_on(const CompareOptions& options, const Surface& surface, LoadedHeightmap& loaded,
                const std::vector<UserForm>& own, StagedFolder& folder, Plots& plots) {
  const Stopwatch watch;
  std::vector<ComparedAlbedo> albedos = compared_albedos(options, surface);
  const std::uint64_t memory = memory_for_methods(options, surface, albedos);
  const ComparisonStudy study(surface, {.albedos = std::move(albedos),
                                        .own_forms = own,
                                        .sky = read_compared_sky(options),
                                        .azimuths = options.azimuths,
                                        .memory = memory,
                                        .seed = options.run.seed,
                                        .watch = terminal_watch(options.run.quiet)});
  for (const std::string& fault : find_faults(study.reference.total_evidence))
    loaded.warnings.push_back({"the reference: " + fault});
  for (const std::string& fault : find_poles(study.own_forms, study.answer))
    loaded.warnings.push_back({fault});
  const ReportInput input{.map_name = printable(options.map.path.filename()),
                          .scene = study.scene,
                          .reference = study.reference,
                          .comparison = study.comparison,
                          .answer = study.answer,
                          .own_forms = study.own_forms,
                          .depth_cost = study.depth_cost,
                          .warnings = loaded.warnings};
  write_comparison_csv(folder.file("compare.csv"), study.comparison.rows);
  write_report(folder.file("report.md"), input);
  if (!study.own_forms.empty()) {
    write_bytes(folder.file("forms.glsl"), shader_of_forms(study.own_forms, ShaderLanguage::glsl));
    write_bytes(folder.file("forms.hlsl"), shader_of_forms(study.own_forms, ShaderLanguage::hlsl));
  }
  write_error_pictures(folder, study.comparison.shown);
  draw_comparison(folder, input, plots);
  if (options.report) {
    std::vector<PageFact> inputs{input_fact(options.map.path, loaded.facts.sha256)};
    append(inputs, input_facts({options.albedo, options.forms.file, options.sky}));
    write_comparison_report(folder.file(kReportFile), inputs, input, watch.elapsed().wall);
  }
  const std::vector<FileRecord> files = folder.written();
  write_bytes(folder.file("compare.json"), comparison_json(options.map.path, loaded, input, files));
  const std::vector<std::string> removed = folder.commit();
  tell_warnings(options.map.path, loaded.warnings);
  if (options.run.quiet) return;
  report_removed(removed);
  fmt::print("{}: {} lines in {}\n", printable(options.map.path), study.comparison.rows.size(),
             printable(options.folder / "compare.csv"));
}

void compare(CompareOptions& options) {
  apply_run_options(options.run);
  check_azimuths(options.azimuths);
  const std::vector<UserForm> own = read_user_forms(options.forms.forms, options.forms.file);
  StagedFolder folder(options.folder, {options.map.path, options.albedo, options.forms.file, options.sky},
                      result_names(), {.file = "compare.json", .prefix = "error_"});
  Plots plots;
  keep_promise(options.run, [&] {
    LoadedHeightmap loaded = load_heightmap(options.map.path, options.map.load, options.run.memory);
    const Surface surface = build_surface(std::move(loaded.map));
    name_errors(options.map.path, [&] { compare_on(options, surface, loaded, own, folder, plots); });
  });
  plots.check();
}

}  // namespace

void add_compare_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "compare", "Compare closed forms and methods for AO and bounces with light transport: errors and time");
  auto options = std::make_shared<CompareOptions>();
  add_map_options(*command, options->map);
  command->add_option("-o,--output", options->folder, "folder for the results")->type_name("DIR")->required();
  CLI::Option* terrain = add_terrain_options(*command, options->terrain);
  CLI::Option* specular = add_specular_options(*command, options->specular);
  CLI::Option* directional = add_directional_option(*command, options->directional);
  specular->excludes(terrain)->excludes(directional);
  directional->excludes(terrain);
  CLI::Option* albedo = command
                            ->add_option("--albedo", options->albedo,
                                         "albedos for the total irradiance: one to eight numbers, a colour, "
                                         "or an image of the size of the map (default 0.2,0.5,0.8)")
                            ->type_name("R,R…|#RRGGBB|FILE")
                            ->excludes(specular)
                            ->excludes(directional);
  command
      ->add_option("--sky", options->sky,
                   "image of radiance by latitude and longitude whose direct irradiance is compared "
                   "(default: a sky of two tones); the middle of the image faces the top of the map")
      ->type_name("FILE.hdr|exr")
      ->excludes(terrain)
      ->excludes(specular);
  command
      ->add_option(
          "--azimuths", options->azimuths,
          "number of azimuths of the reference, even, 2 to 65536 (default 128); the report gives its error")
      ->excludes(terrain)
      ->excludes(specular)
      ->excludes(directional);
  add_user_form_options(*command, options->forms);
  add_report_option(*command, options->report);
  for (CLI::Option* other : {terrain, specular, directional})
    command->get_option("--report")->excludes(other);
  for (const char* own : {"--form", "--forms"}) {
    for (CLI::Option* other : {terrain, specular, directional}) command->get_option(own)->excludes(other);
  }
  add_run_options(*command, options->run);
  command->footer(
      "Writes report.md, which begins with the answer: the error of each closed form on exact AO and on AO "
      "of GTAO;\n"
      "forms, pareto (.svg, .png), showtime.png (how it looks), errors.png, total_errors.png, "
      "sky_light.png,\n"
      "directions.png, error_NN_METHOD.png; compare.csv, compare.json; forms.glsl and .hlsl where --form "
      "gives one.\n"
      "With --terrain: terrain.md, terrain_forms.csv, terrain_methods (.csv, .svg, .png), terrain.json.\n"
      "With --specular: specular (.md, .csv, .png, .json). With --directional: directional (.md, .csv, "
      ".png,\n"
      ".json), and cone_forms.csv: the errors of the forms, independent of the map.\n"
      "Examples:\n"
      "  heightlight compare brick.png -o brick\n"
      "  heightlight compare dem.tif -o dem --texel 50 --boundary open --albedo 0.3\n"
      "  heightlight compare dem.tif -o dem --texel 50 --boundary open --terrain --sun 135,30\n"
      "  heightlight compare brick.png -o brick --specular --roughness 0.1,0.3 --view 135,45\n"
      "  heightlight compare brick.png -o brick --directional --sky studio.exr\n"
      "  heightlight compare brick.png -o brick --form 'mine = A/(1 - rho*(1 - A)^k)'");
  command->callback([options, albedo] {
    if (options->specular.wanted)
      return compare_specular({.map = options->map,
                               .run = options->run,
                               .folder = options->folder,
                               .specular = options->specular});
    if (options->directional)
      return compare_directional(
          {.map = options->map, .run = options->run, .folder = options->folder, .sky = options->sky});
    if (!options->terrain.wanted) return compare(*options);
    compare_terrain({.map = options->map,
                     .run = options->run,
                     .folder = options->folder,
                     .albedo = albedo->empty() ? "" : options->albedo,
                     .sun = options->terrain.sun});
  });
}

}  // namespace heightlight
