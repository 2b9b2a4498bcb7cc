#include <algorithm>
#include <string>

#include "base/stopwatch.h"
#include "cli/bounce_sink.h"
#include "cli/memory_promise.h"
#include "cli/name_errors.h"
#include "cli/reach_options.h"
#include "cli/report_facts.h"
#include "cli/simulate_report.h"
#include "cli/simulation.h"
#include "cli/simulation_files.h"
#include "files/input_file.h"
#include "files/printable.h"
#include "heightlight/error.h"
#include "plot/curve_plots.h"
#include "relief/relief_study.h"
#include "transport/map_gather.h"
#include "visibility/horizon_sky.h"

namespace heightlight {
namespace {

// The study of the height amplitude in the figure: shares of the width, on a coarse copy of the map.
const std::vector<double> kStudiedReliefs{0.01, 0.03, 0.1, 0.3, 1.0};
constexpr int kStudySide = 128;
constexpr int kStudyBins = 40;

InputGuard guard_inputs(const SimulateOptions& options) {
  if (options.inputs) return *options.inputs;
  std::vector<std::filesystem::path> files = light_files(options.light);
  files.insert(files.end(), {options.map.path, options.albedo});  // an albedo that is a number names no file
  return files;
}

Albedo read_input_albedo(const SimulateOptions& options, const Heightmap& map) {
  ReadAlbedo read = read_albedo(options.albedo, map, options.run.memory);
  if (!options.albedo_sha256.empty() && read.sha256 != options.albedo_sha256)
    throw file_error(options.albedo, "was changed while it was in use");
  return std::move(read.albedo);
}

/// What the sink, the albedo, the totals as maps and light of one's own hold beside the solution.
std::uint64_t bytes_held(int width, int height, const SimulateOptions& options, const Albedo& albedo) {
  const auto texels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  constexpr std::uint64_t kVector = sizeof(TexelVector::value_type);
  constexpr std::uint64_t kMap = sizeof(Map::value_type);
  const bool lit = has_own_light(options.light);
  const std::uint64_t ends =
      options.save_links ? sizeof(std::int64_t) : 0;  // of rows, while links are written
  const std::uint64_t transfer = options.obscurance.empty() ? 0 : (1 + albedo.channels()) * kMap;
  // As it was found, as it is solved for, and as maps; two operators at once, one with the results so far.
  const std::uint64_t light = lit ? 3 * (2 * kVector + kMap) + 2 * horizon_sky_bytes({}) + kVector : 0;
  const std::uint64_t per_texel = ends + transfer + light + SimulationSink::bytes_per_texel() +
                                  albedo.channels() * kMap + albedo.varying.size() * kVector;
  const std::uint64_t report = options.report ? simulation_report_bytes(width, height, albedo, lit) : 0;
  return texels * per_texel + (lit ? gather_bytes(width, height, 0) : 0) + report;
}

Request make_request(const SimulateOptions& options, const Albedo& albedo, const Watch& watch) {
  Request request;
  request.wanted = {.sky = true, .totals = {albedo}, .bounces = options.bounces};
  request.accuracy = make_accuracy(options.visibility, options.run.seed);
  request.checks.sky = false;  // A is checked with the total
  request.watch = watch;
  return request;
}

/// Keeps nothing: what a sink holds, bytes_held tells.
struct ForgetfulSink : BounceSink {
  void take_sky(const Map&, const Map&) override {}
  void take_bounce(int, const TexelVector&) override {}
  void take_tail(const TexelVector&) override {}
};

/// Of an albedo, only the number of channels counts, and whether it varies.
std::uint64_t simulation_bytes(int width, int height, const SimulateOptions& options, const Albedo& albedo) {
  ForgetfulSink sink;
  Request request = make_request(options, albedo, {});
  request.sink = &sink;
  return bytes_held(width, height, options, albedo) + estimate_memory(width, height, request);
}

LoadedHeightmap load_input(const SimulateOptions& options) {
  const Albedo albedo = announced_albedo(options.albedo);
  LoadedHeightmap loaded =
      load_heightmap(options.map.path, options.map.load, options.run.memory,
                     [&](int width, int height) { return simulation_bytes(width, height, options, albedo); });
  if (!options.sha256.empty() && loaded.facts.sha256 != options.sha256)
    throw file_error(options.map.path, "was changed while it was in use");
  return loaded;
}

/// Bounces under an even sky and the total under a light of one's own: by one operator where links are
/// stored, while walks are planned for each of the two.
Results solve_with_light(const Surface& surface, const Request& request, std::vector<TexelVector> direct) {
  const PlannedTransport found = find_operator(surface, request);
  Request bounces = request;
  bounces.transport = &found;
  bounces.limits.memory -= std::min(bounces.limits.memory, found.transport->bytes());
  Request total = bounces;
  bounces.wanted.totals = {};
  bounces.checks.sky = true;  // the total's check is of the sky that its own walks find
  total.wanted = {.totals = request.wanted.totals, .direct = std::move(direct)};
  total.sink = nullptr;
  if (request.accuracy.visibility == Visibility::horizon_walks) total.transport = nullptr;
  Results results = solve(surface, bounces);
  Results lit = solve(surface, total);
  results.totals = std::move(lit.totals);
  results.evidence.total_checks = lit.evidence.total_checks;
  results.evidence.audits = lit.evidence.audits;
  results.evidence.gathers = lit.evidence.gathers;
  if (lit.evidence.plan) results.evidence.plan->gather = lit.evidence.plan->gather;
  results.evidence.refined = lit.evidence.refined;
  if (const std::optional<SkyCheck>& sky = results.evidence.sky_check) {
    for (HorizonCheck& check : results.evidence.total_checks) {
      check.sky_rmse = sky->sky_view_factor;
      check.ambient_rmse = sky->ambient_occlusion;
    }
  }
  results.evidence.seconds.bounces += lit.evidence.seconds.bounces;
  results.evidence.seconds.check += lit.evidence.seconds.check;
  return results;
}

/// What the figure of the curves shows: them, and a study of the relief.
CurvePlotInput curve_plot(const SimulateOptions& options, const Surface& surface,
                          const std::vector<BounceCurves>& curves, const Watch& watch) {
  const ReliefStudy study{.relief_shares = kStudiedReliefs, .largest_side = kStudySide, .bins = kStudyBins};
  return {.ambient_occlusion = curves[0],
          .sky_view_factor = curves[1],
          .reliefs = study_reliefs(surface.map, study, watch),
          .title = printable(options.map.path.filename())};
}

/// What sends the first light, where that is no even sky; notes it.
DirectIrradiance find_light(const SimulateOptions& options, const Surface& surface, Simulation& simulation,
                            const Watch& watch) {
  DirectIrradiance light =
      find_direct_irradiance(options.light, surface,
                             {.error = options.visibility.error.value_or(LightLimits{}.error),
                              .seed = options.run.seed,
                              .memory = memory_beside(options.run, surface),
                              .watch = watch});
  simulation.light = light.description;
  simulation.light_rmse = light.rmse;
  return light;
}

std::vector<Map> to_maps(const std::vector<TexelVector>& channels, const Surface& surface) {
  std::vector<Map> maps;
  for (const TexelVector& values : channels) maps.push_back(to_map(values, surface));
  return maps;
}

void write_maps(const MapFolder& output, const Surface& surface, const Results& results,
                const SimulationSink& sink, const std::vector<Map>& totals) {
  write_occlusion(output, results);
  write_totals(output, totals);
  write_pictures(output.folder, surface, results, sink.first(), totals);
}

}  // namespace

void check_simulate_options(const SimulateOptions& options) {
  check_visibility_options(options.visibility);
  check_light_options(options.light);
  const bool has_links = options.visibility.by_rays() || options.visibility.error == 0.0;
  if (options.save_links && !has_links)
    throw UsageError("save-links", "", "needs --visibility rays or --error 0: horizon walks store no links");
  if (!options.obscurance.empty()) {
    if (!has_links)
      throw UsageError("obscurance", "",
                       "needs --visibility rays or --error 0: horizon walks store no links");
    if (!(parse_distance("obscurance", options.obscurance, 1) > 0))
      throw UsageError("obscurance", options.obscurance, "must be positive");
  }
  if (options.bounces < 1 || options.bounces > 1000) {
    throw UsageError("bounces", std::to_string(options.bounces), "must be from 1 to 1000");
  }
  if (options.bins < 1 || options.bins > 10000) {
    throw UsageError("bins", std::to_string(options.bins), "must be from 1 to 10000");
  }
}

namespace {

Simulation simulate_within(const SimulateOptions& options, Plots& plots, const Watch& watch) {
  Stopwatch total;
  Stopwatch lap;
  Simulation simulation;
  StepTimes& seconds = simulation.seconds;
  check_simulate_options(options);
  StagedFolder folder(options.folder, guard_inputs(options), simulation_file_names(options.bounces),
                      {.file = "summary.json", .prefix = "irradiance_"});
  LoadedHeightmap loaded = load_input(options);
  simulation.facts = loaded.facts;
  simulation.warnings = loaded.warnings;
  const Surface surface = build_surface(std::move(loaded.map));
  simulation.width = surface.width();
  simulation.height = surface.height();
  const Albedo albedo = read_input_albedo(options, surface.map);
  seconds.load = lap.lap();

  const MapFolder output{.folder = folder, .place = loaded.place};
  const DirectIrradiance light = find_light(options, surface, simulation, watch);
  seconds.light = lap.lap();

  SimulationSink sink(surface, albedo, options, output);
  const Results results = name_errors(options.map.path, [&] {
    Request request = make_request(options, albedo, watch);
    const std::uint64_t held = bytes_held(surface.width(), surface.height(), options, albedo);
    request.limits.memory = options.run.memory - std::min(options.run.memory, held);
    request.sink = &sink;
    return light.channels.empty() ? solve(surface, request)
                                  : solve_with_light(surface, request, light.channels);
  });
  simulation.evidence = results.evidence;
  for (const std::string& fault : find_faults(results.evidence)) simulation.warnings.push_back({fault});
  simulation.evidence.estimated_bytes += bytes_held(surface.width(), surface.height(), options, albedo);
  lap.lap();
  const std::vector<BounceCurves> curves = sink.curves();
  write_curves_csv(folder.file("curves.csv"), curves);
  if (plots.possible()) {
    const CurvePlotInput input = curve_plot(options, surface, curves, watch);
    plots.draw(folder, {"curves.svg", "curves.png"},
               [&](const auto& paths) { plot_curves(paths[0], paths[1], input); });
  }
  seconds.curves = results.evidence.seconds.sink + lap.lap();
  const std::vector<Map> totals = to_maps(results.totals[0], surface);
  const std::vector<Map> direct = to_maps(light.channels, surface);
  write_maps(output, surface, results, sink, totals);
  if (!direct.empty()) write_direct(output, direct);
  seconds.output = lap.lap();
  seconds.total = total.lap();
  if (options.report) {
    write_simulation_report(folder.file(kReportFile), options, simulation,
                            {.surface = surface,
                             .results = results,
                             .totals = totals,
                             .direct = direct,
                             .bounces = sink.reported(),
                             .curves = curves});
  }
  simulation.files = folder.written();
  write_summary(folder.file("summary.json"), options, surface, albedo, simulation);
  simulation.removed = folder.commit();
  return simulation;
}

}  // namespace

Simulation simulate_map(const SimulateOptions& options, Plots& plots, const Watch& watch) {
  return keep_promise(options.run, [&] { return simulate_within(options, plots, watch); });
}

}  // namespace heightlight
