#include <cmath>
#include <set>
#include <system_error>

#include "cli/bounce_sink.h"
#include "cli/simulation.h"
#include "cli/simulation_files.h"
#include "cli/solve_bounces.h"
#include "core/byte_size.h"
#include "core/stopwatch.h"
#include "heightlight/error.h"
#include "io/input_file.h"
#include "plot/curve_plots.h"

namespace heightlight {
namespace {

// The study of the height amplitude in the figure: shares of the width, on a coarse copy of the map.
const std::vector<double> kStudiedReliefs{0.01, 0.03, 0.1, 0.3, 1.0};
constexpr int kStudySide = 128;
constexpr int kStudyBins = 40;

/// Inputs are never replaced: a map called height.png would be, if the results went into its own folder.
void refuse_to_replace(const std::filesystem::path& input, const std::filesystem::path& folder) {
  static const std::set<std::string> kResults{
      "height.png", "ambient_occlusion.png", "sky_view_factor.png", "irradiance_total.png", "bounces.png",
      "curves.png", "ambient_occlusion.exr", "sky_view_factor.exr", "irradiance_total.exr"};
  const std::string name = input.filename().string();
  const bool is_result =
      kResults.contains(name) || (name.starts_with("irradiance_") && name.ends_with(".exr"));
  std::error_code ignored;  // of files that do not exist, which nothing replaces
  if (is_result && std::filesystem::equivalent(input, folder / name, ignored)) {
    throw UsageError(input.string() + ": the results would replace it; choose another folder with -o");
  }
}

/// Memory for the links: what the maps and vectors of the other steps leave of the limit.
std::uint64_t memory_for_links(const SimulateOptions& options, const Heightmap& map) {
  // Heights, normals, pyramids, AO and light maps, bounces and their sums, previews, the bins; with rays or
  // exact slices some 10 vectors of the solver, too.
  const bool solves = options.visibility.by_rays() || options.visibility.exact();
  const std::uint64_t bytes_per_texel = solves ? 320 : 200;
  const std::uint64_t needed = map.height.size() * bytes_per_texel;
  if (needed >= options.run.memory) {
    throw Error(options.map.path.string() + ": simulating " + std::to_string(map.height.width) + " × " +
                std::to_string(map.height.height) + " texels needs " + format_byte_size(needed) +
                " beside its links, more than the " + format_byte_size(options.run.memory) +
                " allowed by --memory");
  }
  return options.run.memory - needed;
}

/// The error that the summary reports: of rays against more rays, of horizon walks against exact ones.
void estimate_errors(const SimulateOptions& options, const Surface& surface, const Transport& transport,
                     const TexelVector& total, const Albedo& albedo, Simulation& simulation) {
  if (options.visibility.by_rays()) {
    const double rmse = estimate_ray_rmse(surface, {options.visibility.ray_count(), options.run.seed});
    if (!std::isnan(rmse)) simulation.rmse_estimate = rmse;
    return;
  }
  const TexelVector reflectance =
      albedo.varying.empty() ? TexelVector::Constant(total.size(), albedo.constant[0]) : albedo.varying[0];
  const HorizonCheck check = check_by_exact_walks(surface, transport, total, reflectance, options.run.seed);
  if (check.receivers == 0) return;
  simulation.check = check;
  simulation.rmse_estimate = check.sky_rmse;
}

LoadedHeightmap load_input(const SimulateOptions& options) {
  refuse_to_replace(options.map.path, options.folder);
  refuse_to_replace(options.albedo, options.folder);
  LoadedHeightmap loaded = load_heightmap(options.map.path, options.map.load, options.run.memory);
  if (!options.sha256.empty() && loaded.facts.sha256 != options.sha256)
    throw file_error(options.map.path, "was changed while it was in use");
  return loaded;
}

/// Finds visibility, and notes how.
std::unique_ptr<Transport> find_transport(const SimulateOptions& options, const Surface& surface,
                                          std::uint64_t link_memory, Simulation& simulation) {
  Stopwatch watch;
  FoundVisibility found =
      find_visibility(surface, options.visibility, options.run, options.map.path.string(), link_memory);
  simulation.plan = found.plan;
  simulation.seconds.visibility = watch.lap();
  simulation.links = found.transport->link_count();
  simulation.link_bytes = found.transport->bytes();
  simulation.energy.row_sum_max_error = row_sum_error(*found.transport);
  simulation.seconds.transport = watch.lap();
  return std::move(found.transport);
}

/// The curves, and their figure with a study of the relief.
void write_curves(StagedFolder& folder, const SimulateOptions& options, const Surface& surface,
                  const std::vector<BounceCurves>& curves, StepTimes& seconds) {
  Stopwatch watch;
  write_curves_csv(folder.file("curves.csv"), curves);
  const std::vector<ReliefCurves> study =
      study_reliefs(surface.map, kStudiedReliefs, kStudySide, 1, kStudyBins, options.run.quiet);
  seconds.curves += watch.lap();
  plot_curves(folder.file("curves.svg"), folder.file("curves.png"),
              {curves[0], curves[1], study, options.map.path.filename().string()});
  seconds.output += watch.lap();
}

}  // namespace

void check_simulate_options(const SimulateOptions& options) {
  check_visibility_options(options.visibility, options.run.seed);
  if (options.bounces < 1 || options.bounces > 1000) {
    throw UsageError("--bounces " + std::to_string(options.bounces) + ": must be from 1 to 1000");
  }
  if (options.bins < 1 || options.bins > 10000) {
    throw UsageError("--bins " + std::to_string(options.bins) + ": must be from 1 to 10000");
  }
}

Simulation simulate_map(const SimulateOptions& options) {
  Stopwatch total;
  Stopwatch watch;
  Simulation simulation;
  StepTimes& seconds = simulation.seconds;
  check_simulate_options(options);

  LoadedHeightmap loaded = load_input(options);
  simulation.facts = loaded.facts;
  simulation.width = loaded.map.height.width;
  simulation.height = loaded.map.height.height;
  const std::uint64_t link_memory = memory_for_links(options, loaded.map);
  const Surface surface = build_surface(std::move(loaded.map));
  const Albedo albedo = read_albedo(options.albedo, surface.map, options.run.memory);
  StagedFolder folder(options.folder);
  seconds.load = watch.lap();

  const std::unique_ptr<Transport> transport = find_transport(options, surface, link_memory, simulation);
  watch.lap();
  BounceSink sink(*transport, surface, options, folder);
  const SolvedBounces solved = solve_bounces(*transport, surface, albedo, options,
                                             simulation.plan.has_value(), sink, simulation.energy);
  simulation.seen = sink.seen();
  simulation.seen.deep = solved.deep_seen;
  seconds.curves = sink.seconds();
  seconds.bounces = watch.lap() - seconds.curves;
  estimate_errors(options, surface, *transport, solved.totals[0], albedo, simulation);
  seconds.check = watch.lap();

  write_curves(folder, options, surface, sink.curves(), seconds);
  watch.lap();
  std::vector<Map> totals;
  for (const TexelVector& values : solved.totals) totals.push_back(to_map(values, surface));
  write_occlusion(folder, *transport);
  write_totals(folder, totals);
  write_pictures(folder, surface, *transport, sink.first(), totals);
  seconds.output += watch.lap();
  seconds.total = total.lap();
  write_summary(folder.file("summary.json"), options, surface, albedo, simulation);
  folder.commit();
  return simulation;
}

}  // namespace heightlight
