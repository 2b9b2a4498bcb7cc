#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>

#include "cli/albedo.h"
#include "cli/commands.h"
#include "cli/map_options.h"
#include "comparison/comparison_csv.h"
#include "comparison/report.h"
#include "core/byte_size.h"
#include "heightlight/error.h"
#include "heightlight/screenspace.h"
#include "io/image_file.h"
#include "io/staged_output.h"
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
    char label[32];
    std::snprintf(label, sizeof label, "%g", constant);
    albedos.push_back(
        {label, TexelVector::Constant(static_cast<Eigen::Index>(surface.map.height.size()), constant), {}});
  }
  constexpr std::array<const char*, 3> kChannels{"R", "G", "B"};
  for (std::size_t c = 0; c < albedo.varying.size(); ++c) {
    albedos.push_back({albedo.varying.size() == 1 ? "map" : kChannels.at(c), albedo.varying[c],
                       to_map(albedo.varying[c], surface)});
  }
  return albedos;
}

/// Memory for links: what maps, the depth buffer and the methods' results leave of the limit.
std::uint64_t memory_for_links(const CompareOptions& options, const Heightmap& map) {
  constexpr std::uint64_t kBytesPerTexel = 420;
  const std::uint64_t needed = map.height.size() * kBytesPerTexel +
                               depth_buffer_bytes(map.height.width, map.height.height, map.boundary);
  if (needed < options.run.memory) return options.run.memory - needed;
  throw Error(options.map.path.string() + ": comparing " + std::to_string(map.height.width) + " × " +
              std::to_string(map.height.height) + " texels needs " + format_byte_size(needed) +
              " beside its links, more than the " + format_byte_size(options.run.memory) +
              " allowed by --memory");
}

void write_error_pictures(StagedFolder& folder, const std::vector<ErrorMap>& maps, const std::string& title) {
  int number = 0;
  for (const ErrorMap& map : maps) {
    std::string method = map.method;
    std::replace(method.begin(), method.end(), ' ', '_');
    char name[128];
    std::snprintf(name, sizeof name, "error_%02d_%s.png", ++number, method.c_str());
    write_png(folder.file(name), difference_picture(map.differences));
  }
  plot_error_sheet(folder.file("errors.png"), maps, title);
}

void compare(CompareOptions& options) {
  apply_run_options(options.run);
  check_azimuths(options.azimuths);
  LoadedHeightmap loaded = load_heightmap(options.map.path, options.map.load, options.run.memory);
  const std::uint64_t link_memory = memory_for_links(options, loaded.map);
  const Surface surface = build_surface(std::move(loaded.map));
  const std::vector<ComparedAlbedo> albedos =
      compared_albedos(read_albedo(options.albedo, surface.map, options.run.memory), surface);
  StagedFolder folder(options.folder);

  const Stopwatch watch;
  const DepthBuffer depth = make_depth_buffer(surface);
  const Cost depth_cost = watch.elapsed();
  const Reference reference =
      build_reference(surface, {options.azimuths, albedos, link_memory, options.run.seed, options.run.quiet});
  const ComparedScene scene{surface, depth, albedos, link_memory, options.run.seed};
  const Comparison comparison = compare_methods(scene, reference, make_contenders(scene), options.run.quiet);

  const std::string name = options.map.path.filename().string();
  write_comparison_csv(folder.file("compare.csv"), comparison.rows);
  write_report(folder.file("report.md"), {name, scene, reference, comparison, depth_cost});
  plot_pareto(folder.file("pareto.svg"), folder.file("pareto.png"), comparison.rows,
              {kSkyQuantity, total_quantity(albedos.back())}, name);
  write_error_pictures(folder, comparison.shown, name);
  folder.commit();
  if (!options.run.quiet) {
    std::printf("%s: %zu lines in %s\n", options.map.path.c_str(), comparison.rows.size(),
                (options.folder / "compare.csv").c_str());
  }
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
      "Writes compare.csv, report.md, pareto.svg and .png, errors.png, and error_NN_METHOD.png.\n"
      "Examples:\n"
      "  heightlight compare brick.png -o brick\n"
      "  heightlight compare dem.tif -o dem --texel 50 --boundary open --albedo 0.3");
  command->callback([options] { compare(*options); });
}

}  // namespace heightlight
