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

/// The walks of a plan, and what the pilot expected of each part.
void add_plan(const HorizonPlan& plan, Json& visibility) {
  visibility["azimuths"] = plan.sky.azimuths;
  visibility["full_from"] = plan.sky_full_from;
  visibility["full_share"] = plan.sky_full_share;
  visibility["fineness"] = plan.sky.fineness;
  visibility["peak_share"] = plan.sky.peak_share;
  visibility["links"] = {{"azimuths", plan.links.azimuths},
                         {"fineness", plan.links.fineness},
                         {"stride", plan.lattice_stride},
                         {"own_share", plan.own_share}};
  visibility["expected_rmse"] = {{"sky_view_factor", plan.sky_error}, {"total_from_links", plan.link_error}};
}

Json describe_visibility(const SimulateOptions& options, const Simulation& simulation) {
  const VisibilityOptions& chosen = options.visibility;
  Json visibility = {{"method", chosen.by_rays() ? "rays" : "horizon"},
                     {"azimuths", nullptr},
                     {"rays", nullptr},
                     {"seed", options.run.seed},
                     {"rmse_estimate", nullptr}};
  if (chosen.by_rays()) visibility["rays"] = chosen.ray_count();
  if (chosen.exact()) visibility["azimuths"] = chosen.exact_azimuths();
  if (!chosen.by_rays()) visibility["error_wanted"] = chosen.error_wanted();
  if (simulation.plan) add_plan(*simulation.plan, visibility);
  if (simulation.rmse_estimate) visibility["rmse_estimate"] = *simulation.rmse_estimate;
  if (simulation.check) {
    visibility["checked"] = {{"receivers", simulation.check->receivers},
                             {"azimuths", simulation.check->azimuths},
                             {"sky_view_factor_rmse", simulation.check->sky_rmse},
                             {"total_rmse", simulation.check->total_rmse}};
  }
  return visibility;
}

Json describe_times(const StepTimes& seconds) {
  return {{"load", seconds.load},           {"visibility", seconds.visibility},
          {"transport", seconds.transport}, {"bounces", seconds.bounces},
          {"check", seconds.check},         {"curves", seconds.curves},
          {"output", seconds.output},       {"total", seconds.total}};
}

}  // namespace

void write_summary(const std::filesystem::path& path, const SimulateOptions& options, const Surface& surface,
                   const Albedo& albedo, const Simulation& simulation) {
  Json summary;
  summary["version"] = HEIGHTLIGHT_VERSION;
  summary["map"] = describe_map(options, surface, simulation.facts);
  summary["visibility"] = describe_visibility(options, simulation);
  summary["links"] = {{"count", simulation.links}, {"bytes", simulation.link_bytes}};
  summary["bounces"] = options.bounces;
  summary["albedo"] = albedo.varying.empty() ? Json(albedo.constant) : Json(options.albedo);
  summary["energy"] = describe_energy(simulation.energy);
  summary["seen"] = {{"expected_sky_view_factor", simulation.seen.expected},
                     {"mean_sky_view_factor", simulation.seen.mean},
                     {"deep_sky_view_factor", simulation.seen.deep}};
  summary["time_s"] = describe_times(simulation.seconds);
  summary["memory"] = {{"peak_bytes", peak_memory()}};
  summary["threads"] = thread_count();

  // Names of files may hold bytes that are no UTF-8, which JSON cannot.
  write_bytes(path, summary.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

}  // namespace heightlight
