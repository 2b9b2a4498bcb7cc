#include <nlohmann/json.hpp>

#include "cli/simulation.h"
#include "core/byte_size.h"
#include "core/parallel.h"
#include "io/output_file.h"

namespace heightlight {
namespace {

using Json = nlohmann::ordered_json;

Json describe_map(const SimulateOptions& options, const Surface& surface, const SourceFacts& facts) {
  const Heightmap& map = surface.map;
  return {{"path", options.map.path.string()},
          {"sha256", facts.sha256},
          {"width", map.height.width},
          {"height", map.height.height},
          {"texel", {map.spacing.x, map.spacing.y}},
          {"relief", relief(map)},
          {"boundary", to_string(map.boundary)},
          {"missing", count_missing(map)}};
}

Json describe_energy(const EnergyCheck& energy) {
  return {{"row_sum_max_error", energy.row_sum_max_error},
          {"sum_max_error", energy.sum_max_error},
          {"mean_total_over_pi", energy.mean_total_over_pi},
          {"tail_mean", energy.tail_mean},
          {"tail_max", energy.tail_max},
          {"spectral_radius", energy.spectral_radius},
          {"solver_residual", energy.solver_residual},
          {"solver_iterations", energy.solver_iterations}};
}

Json describe_times(const StepTimes& seconds) {
  return {{"load", seconds.load},       {"visibility", seconds.visibility}, {"transport", seconds.transport},
          {"bounces", seconds.bounces}, {"curves", seconds.curves},         {"total", seconds.total}};
}

}  // namespace

void write_summary(const std::filesystem::path& path, const SimulateOptions& options, const Surface& surface,
                   const Albedo& albedo, const Simulation& simulation) {
  Json summary;
  summary["version"] = HEIGHTLIGHT_VERSION;
  summary["map"] = describe_map(options, surface, simulation.facts);
  summary["visibility"] = {{"method", "rays"},
                           {"azimuths", nullptr},
                           {"rays", options.rays},
                           {"seed", options.run.seed},
                           {"rmse_estimate", nullptr}};
  if (simulation.rmse_estimate) summary["visibility"]["rmse_estimate"] = *simulation.rmse_estimate;
  summary["links"] = {{"count", simulation.links}, {"bytes", simulation.link_bytes}};
  summary["bounces"] = options.bounces;
  summary["albedo"] = albedo.varying.empty() ? Json(albedo.constant) : Json(options.albedo);
  summary["energy"] = describe_energy(simulation.energy);
  summary["time_s"] = describe_times(simulation.seconds);
  summary["memory"] = {{"peak_bytes", peak_memory()}};
  summary["threads"] = thread_count();

  write_bytes(path, summary.dump(2) + '\n');
}

}  // namespace heightlight
