#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <set>
#include <system_error>

#include "cli/commands.h"
#include "cli/simulation.h"
#include "core/byte_size.h"
#include "heightlight/error.h"
#include "heightlight/models.h"
#include "io/image_file.h"
#include "plot/curve_plots.h"
#include "plot/previews.h"

namespace heightlight {
namespace {

constexpr int kPreviewedBounces = 6;

// The study of the height amplitude in the figure: shares of the width, on a coarse copy of the map.
const std::vector<double> kStudiedReliefs{0.01, 0.03, 0.1, 0.3, 1.0};
constexpr int kStudySide = 128;
constexpr int kStudyBins = 40;

/// Seconds since the last call.
class StopWatch {
 public:
  double lap() {
    const Clock::time_point now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

void check_options(const SimulateOptions& options) {
  check_visibility_options(options.visibility, options.run.seed);
  if (options.bounces < 1 || options.bounces > 1000) {
    throw UsageError("--bounces " + std::to_string(options.bounces) + ": must be from 1 to 1000");
  }
  if (options.bins < 1 || options.bins > 10000) {
    throw UsageError("--bins " + std::to_string(options.bins) + ": must be from 1 to 10000");
  }
}

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

using Attributes = std::vector<std::pair<std::string, std::string>>;

void write_map(StagedFolder& folder, const std::string& name, const Map& map, const std::string& meaning) {
  write_float_image(folder.file(name), {{"Y", &map}}, Attributes{{"ImageDescription", meaning}});
}

/// The bounces on their way: into curves, previews and, where asked, files.
class BounceSink {
 public:
  BounceSink(const Transport& transport, const Surface& surface, const SimulateOptions& options,
             StagedFolder& folder)
      : surface_(surface),
        options_(options),
        folder_(folder),
        sky_view_factor_(transport.sky_view_factor),
        alpha_(transport.ambient_occlusion, AoKind::ambient_occlusion, options.bins),
        sky_(transport.sky_view_factor, AoKind::sky_view_factor, options.bins) {
    seen_.expected = expected_seen(transport.sky_view_factor, surface).value;
  }

  void take(int b, const TexelVector& irradiance) {
    StopWatch watch;
    alpha_.add(irradiance);
    sky_.add(irradiance);
    seconds_ += watch.lap();
    if (b == 1) seen_.mean = measured_seen(sky_view_factor_, irradiance, surface_).value;
    if (b < kPreviewedBounces) first_.push_back(to_map(irradiance, surface_));
    if (!options_.save_bounces) return;
    char name[32];
    std::snprintf(name, sizeof name, "irradiance_%02d.exr", b);
    write_map(folder_, name, to_map(irradiance, surface_), "E_b / pi at albedo 1, b = " + std::to_string(b));
  }

  void take_tail(const TexelVector& tail) {
    alpha_.add_tail(tail);
    sky_.add_tail(tail);
  }

  const std::vector<Map>& first() const { return first_; }
  const SeenSky& seen() const { return seen_; }
  std::vector<BounceCurves> curves() const { return {alpha_.curves(), sky_.curves()}; }
  double seconds() const { return seconds_; }  ///< spent on the curves

 private:
  const Surface& surface_;
  const SimulateOptions& options_;
  StagedFolder& folder_;
  const Map& sky_view_factor_;
  SeenSky seen_;
  CurveBuilder alpha_;
  CurveBuilder sky_;
  std::vector<Map> first_;
  double seconds_ = 0;
};

/// What is left after the last bounce, at constant albedo: solved for where links are exact, from
/// conservation where they are walked.
Equilibrium find_tail(const Transport& transport, const BounceSeries& series, double albedo,
                      bool by_conservation, bool quiet) {
  if (!by_conservation) return solve_tail(transport, series, albedo, quiet);
  return {conserve_tail(transport, series.sum, series.last, series.bounces, albedo), 0, 0};
}

/// Total irradiance of all bounces, one vector per channel of the albedo.
std::vector<TexelVector> find_totals(const Transport& transport, const BounceSeries& series,
                                     const Albedo& albedo, bool by_conservation, EnergyCheck& energy,
                                     bool quiet) {
  std::vector<TexelVector> totals;
  const auto note = [&energy](const Equilibrium& solved) {
    energy.solver_residual = std::max(energy.solver_residual, solved.residual);
    energy.solver_iterations = std::max(energy.solver_iterations, solved.iterations);
  };
  for (std::size_t channel = 0; channel < albedo.constant.size(); ++channel) {
    const Equilibrium tail = find_tail(transport, series, albedo.constant[channel], by_conservation, quiet);
    note(tail);
    totals.push_back(series.weighted[channel] + tail.irradiance);
  }
  for (const TexelVector& reflectance : albedo.varying) {
    const Equilibrium all =
        solve_equilibrium(transport, transport.direct, reflectance, transport.direct, quiet);
    note(all);
    totals.push_back(all.irradiance);
  }
  return totals;
}

/// Compares E₀ + … + E_K + tail with 1. (A tail from conservation is taken from that sum; the rows are
/// checked then.)
void check_energy(const Transport& transport, const BounceSeries& series, const Equilibrium& tail,
                  EnergyCheck& energy) {
  energy.spectral_radius = series.spectral_radius;
  energy.solver_residual = tail.residual;
  energy.solver_iterations = tail.iterations;
  double sum = 0;
  double tail_sum = 0;
  std::size_t receivers = 0;
  for (Eigen::Index i = 0; i < series.sum.size(); ++i) {
    if (std::isnan(transport.sky_view_factor.values[static_cast<std::size_t>(i)])) continue;
    const double total = series.sum[i] + tail.irradiance[i];
    energy.sum_max_error = std::max(energy.sum_max_error, std::fabs(total - 1));
    energy.tail_max = std::max(energy.tail_max, tail.irradiance[i]);
    sum += total;
    tail_sum += tail.irradiance[i];
    ++receivers;
  }
  energy.mean_total_over_pi = sum / static_cast<double>(receivers);
  energy.tail_mean = tail_sum / static_cast<double>(receivers);
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

void write_totals(StagedFolder& folder, const std::vector<Map>& totals) {
  static constexpr const char* kColour[] = {"R", "G", "B"};
  std::vector<std::pair<std::string, const Map*>> channels;
  for (std::size_t i = 0; i < totals.size(); ++i)
    channels.push_back({totals.size() == 1 ? "Y" : kColour[i], &totals[i]});
  write_float_image(folder.file("irradiance_total.exr"), channels,
                    Attributes{{"ImageDescription", "E / pi of all bounces, at the albedo given"}});
}

void write_pictures(StagedFolder& folder, const Surface& surface, const Transport& transport,
                    const std::vector<Map>& first_bounces, const std::vector<Map>& totals) {
  write_png(folder.file("height.png"), height_picture(surface));
  write_png(folder.file("ambient_occlusion.png"), grey_picture(transport.ambient_occlusion));
  write_png(folder.file("sky_view_factor.png"), grey_picture(transport.sky_view_factor));
  write_png(folder.file("irradiance_total.png"), colour_picture(totals));
  write_png(folder.file("bounces.png"), bounce_strip(first_bounces));
}

void report(const SimulateOptions& options, const Simulation& simulation, const Surface& surface) {
  if (options.run.quiet) return;
  const StepTimes& s = simulation.seconds;
  std::printf("%s: %d x %d texels, %llu links (%s) in %.1f s\n", options.map.path.c_str(), surface.width(),
              surface.height(), static_cast<unsigned long long>(simulation.links),
              format_byte_size(simulation.link_bytes).c_str(), s.total);
  std::printf("visibility %.1f s, bounces %.1f s, curves %.1f s, output %.1f s\n", s.visibility, s.bounces,
              s.curves, s.output);
  if (simulation.check) {
    std::printf("RMSE against exact walks: %.2g of the sky view factor, %.2g of the total\n",
                simulation.check->sky_rmse, simulation.check->total_rmse);
  } else if (simulation.rmse_estimate) {
    std::printf("RMSE of the sky view factor about %.2g\n", *simulation.rmse_estimate);
  }
  std::printf(
      "energy: sum of all bounces is 1 within %.1g; after %d of them %.2g is left on average (%.2g at "
      "most)\n",
      simulation.energy.sum_max_error, options.bounces, simulation.energy.tail_mean,
      simulation.energy.tail_max);
  std::printf("results in %s\n", options.folder.c_str());
}

void simulate(SimulateOptions& options) {
  StopWatch total;
  StopWatch watch;
  Simulation simulation;
  StepTimes& seconds = simulation.seconds;
  apply_run_options(options.run);
  check_options(options);

  refuse_to_replace(options.map.path, options.folder);
  refuse_to_replace(options.albedo, options.folder);
  LoadedHeightmap loaded = load_heightmap(options.map.path, options.map.load, options.run.memory);
  simulation.facts = loaded.facts;
  const std::uint64_t link_memory = memory_for_links(options, loaded.map);
  const Surface surface = build_surface(std::move(loaded.map));
  const Albedo albedo = read_albedo(options.albedo, surface.map, options.run.memory);
  StagedFolder folder(options.folder);
  seconds.load = watch.lap();

  FoundVisibility found =
      find_visibility(surface, options.visibility, options.run, options.map.path.string(), link_memory);
  const Transport& transport = *found.transport;
  simulation.plan = found.plan;
  seconds.visibility = watch.lap();
  simulation.links = transport.link_count();
  simulation.link_bytes = transport.bytes();
  simulation.energy.row_sum_max_error = row_sum_error(transport);
  seconds.transport = watch.lap();

  BounceSink sink(transport, surface, options, folder);
  const auto visit = [&sink](int b, const TexelVector& irradiance) { sink.take(b, irradiance); };
  const BounceSeries series =
      bounce(transport, surface, options.bounces, albedo.constant, visit, options.run.quiet);
  const bool by_conservation = found.plan.has_value();
  const Equilibrium tail = find_tail(transport, series, 1, by_conservation, options.run.quiet);
  check_energy(transport, series, tail, simulation.energy);
  const std::vector<TexelVector> irradiance =
      find_totals(transport, series, albedo, by_conservation, simulation.energy, options.run.quiet);
  std::vector<Map> totals;
  for (const TexelVector& values : irradiance) totals.push_back(to_map(values, surface));
  seconds.bounces = watch.lap() - sink.seconds();
  estimate_errors(options, surface, transport, irradiance[0], albedo, simulation);
  seconds.check = watch.lap();

  simulation.seen = sink.seen();
  sink.take_tail(tail.irradiance);
  const std::vector<BounceCurves> curves = sink.curves();
  write_curves_csv(folder.file("curves.csv"), curves);
  const std::vector<ReliefCurves> study =
      study_reliefs(surface.map, kStudiedReliefs, kStudySide, 1, kStudyBins, options.run.quiet);
  seconds.curves = watch.lap() + sink.seconds();
  plot_curves(folder.file("curves.svg"), folder.file("curves.png"),
              {curves[0], curves[1], study, options.map.path.filename().string()});
  write_map(folder, "ambient_occlusion.exr", transport.ambient_occlusion,
            "ambient occlusion: share of the hemisphere's solid angle that sees the sky");
  write_map(folder, "sky_view_factor.exr", transport.sky_view_factor,
            "sky view factor: cosine-weighted share of the hemisphere that sees the sky");
  write_totals(folder, totals);
  write_pictures(folder, surface, transport, sink.first(), totals);
  seconds.output = watch.lap();
  seconds.total = total.lap();
  write_summary(folder.file("summary.json"), options, surface, albedo, simulation);
  folder.commit();
  report(options, simulation, surface);
}

}  // namespace

void add_simulate_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("simulate", "AO, sky view factor, links, bounces, curves and plots of a heightmap");
  auto options = std::make_shared<SimulateOptions>();
  add_map_options(*command, options->map);
  command->add_option("-o,--output", options->folder, "folder for the results")->type_name("DIR")->required();
  add_visibility_options(*command, options->visibility);
  command->add_option("--bounces", options->bounces, "bounces to keep apart; the rest is the tail (20)");
  command
      ->add_option("--albedo", options->albedo,
                   "of the total: a number, R,G,B, or an image of the map's size (0.5)")
      ->type_name("R|R,G,B|FILE");
  command->add_option("--bins", options->bins, "AO bins of the curves (100)");
  command->add_flag("--save-bounces", options->save_bounces,
                    "also write irradiance_00.exr, irradiance_01.exr, …");
  add_run_options(*command, options->run);
  command->footer(
      "Examples:\n"
      "  heightlight simulate brick.png -o brick                         a tiling material, relief a tenth "
      "of its width\n"
      "  heightlight simulate rock.exr -o rock --relief 0.3 --albedo 0.6,0.4,0.3\n"
      "  heightlight simulate dem.tif -o dem --texel 50 --boundary open  terrain in metres");
  command->callback([options] { simulate(*options); });
}

}  // namespace heightlight
