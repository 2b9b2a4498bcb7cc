#include "files/evidence_json.h"

#include <numbers>

#include "base/byte_size.h"

namespace heightlight {
namespace {

using Json = nlohmann::ordered_json;

/// Adds the walks of a plan, and the error that the calibration sample predicted for each part.
void add_plan(const HorizonPlan& plan, bool gathers, Json& visibility) {
  visibility["azimuths"] = plan.sky.walk.azimuths;
  visibility["full_from"] = plan.sky.full_from;
  visibility["full_share"] = plan.sky.full_share;
  visibility["fineness"] = plan.sky.walk.samples_per_octave;
  visibility["peak_share"] = plan.sky.walk.peak_share;
  if (gathers) {
    visibility["gathers"] = {{"azimuths", plan.gather.walk.azimuths},
                             {"fineness", plan.gather.walk.samples_per_octave}};
  }
  visibility["expected_rmse"] = {{"sky_view_factor", plan.sky.error}};
  if (gathers) visibility["expected_rmse"]["total_from_gathers"] = plan.gather.error;
}

Json describe_check(const SkyCheck& check) {
  Json json = {{"receivers", check.receivers},
               {"azimuths", check.azimuths},
               {"ambient_occlusion_rmse", check.ambient_occlusion},
               {"sky_view_factor_rmse", check.sky_view_factor}};
  if (check.bent_normal_rad)
    json["bent_normal_rmse_degrees"] = *check.bent_normal_rad * 180 / std::numbers::pi;
  if (check.harmonics) json["sh_coefficient_rmse"] = *check.harmonics;
  return json;
}

Json describe_visibility(const Evidence& evidence) {
  const bool by_rays = evidence.visibility == Visibility::rays;
  Json visibility = {{"method", by_rays ? "rays" : "horizon"},
                     {"azimuths", nullptr},
                     {"rays", nullptr},
                     {"seed", evidence.seed},
                     {"rmse_estimate", nullptr}};
  if (by_rays) visibility["rays"] = evidence.rays;
  if (evidence.azimuths > 0) visibility["azimuths"] = evidence.azimuths;
  if (!by_rays) visibility["error_wanted"] = evidence.error_wanted;
  if (evidence.plan) add_plan(*evidence.plan, evidence.has_links, visibility);
  if (evidence.sky_rmse) visibility["rmse_estimate"] = *evidence.sky_rmse;
  if (!evidence.total_checks.empty()) {
    const HorizonCheck& check = evidence.total_checks[0];
    visibility["checked"] = {{"receivers", check.receivers},
                             {"azimuths", check.azimuths},
                             {"sky_view_factor_rmse", check.sky_rmse},
                             {"total_rmse", check.total_rmse},
                             {"total_standard_error", check.total_standard_error}};
  }
  if (evidence.plan) {
    visibility["refined"] = evidence.refined;
    visibility["missed"] = !missed_error(evidence).empty();
  }
  if (evidence.total_checks.size() > 1) {
    for (const HorizonCheck& check : evidence.total_checks) {
      visibility["checked"]["total_rmse_by_albedo"].push_back(check.total_rmse);
    }
  }
  for (const DefinitionCheck& check : evidence.definition_checks) {
    visibility["definitions"][facts_of(check.definition).name] = {
        {"azimuths", check.azimuths}, {"rmse", check.rmse ? Json(*check.rmse) : Json(nullptr)}};
  }
  if (evidence.sky_check) visibility["checked_sky"] = describe_check(*evidence.sky_check);
  return visibility;
}

Json describe_energy(const Evidence& evidence) {
  const EnergyCheck& energy = *evidence.energy;
  return {{"row_sum_max_error", energy.row_sum_max_error},
          {"row_sum_rmse", energy.row_sum_rmse},
          {"sum_max_error", energy.sum_max_error},
          {"mean_total_over_pi", energy.mean_total_over_pi},
          {"tail_mean", energy.tail_mean},
          {"tail_max", energy.tail_max},
          {"spectral_radius", energy.spectral_radius},
          {"solver_residual", evidence.solver_residual},
          {"solver_iterations", evidence.solver_iterations}};
}

}  // namespace

Json describe_map(const std::filesystem::path& path, const std::string& sha256, const Surface& surface) {
  const Heightmap& map = surface.map;
  return describe_map(path, sha256, map, {.relief = relief(map), .missing = count_missing(map)});
}

Json describe_map(const std::filesystem::path& path, const std::string& sha256, const Heightmap& map,
                  const MapMeasures& measures) {
  Json json = {{"path", path.string()},
               {"sha256", sha256},
               {"width", map.height.width},
               {"height", map.height.height},
               {"texel", {map.spacing.x, map.spacing.y}},
               {"relief", measures.relief},
               {"boundary", to_string(map.boundary)},
               {"missing", measures.missing}};
  if (map.curvature != 0) json["lowered_by"] = {{"times_squared_distance", map.curvature}};
  return json;
}

Json describe_evidence(const Evidence& evidence) {
  Json json;
  json["visibility"] = describe_visibility(evidence);
  if (evidence.has_links) json["links"] = {{"count", evidence.links}, {"bytes", evidence.link_bytes}};
  for (const EnergyAudit& audit : evidence.audits) {
    json["energy_audit"].push_back({{"received_over_pi", audit.received},
                                    {"absorbed", audit.absorbed},
                                    {"escaped", audit.escaped},
                                    {"imbalance", audit.imbalance},
                                    {"found_imbalance", audit.found_imbalance}});
  }
  if (!evidence.bounce_rmse.empty()) json["bounces_rmse"] = evidence.bounce_rmse;
  if (evidence.energy) json["energy"] = describe_energy(evidence);
  if (evidence.seen) {
    json["seen"] = {{"expected_sky_view_factor", evidence.seen->expected},
                    {"mean_sky_view_factor", evidence.seen->mean},
                    {"deep_sky_view_factor", evidence.seen->deep}};
  }
  return json;
}

Json describe_files(const std::vector<FileRecord>& files) {
  Json json = Json::array();
  for (const FileRecord& file : files) json.push_back(describe_file(file));
  return json;
}

Json describe_warnings(const std::vector<Warning>& warnings) {
  Json json = Json::array();
  for (const Warning& warning : warnings)
    json.push_back(warning.message + (warning.remedy.empty() ? "" : " (" + warning.remedy + ")"));
  return json;
}

Json describe_times(const SolveTimes& seconds) {
  return {{"visibility", seconds.visibility},
          {"transport", seconds.transport},
          {"bounces", seconds.bounces},
          {"check", seconds.check}};
}

Json describe_memory(const Evidence& evidence) {
  return {{"peak_bytes", peak_memory()}, {"estimated_bytes", evidence.estimated_bytes}};
}

std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace heightlight
