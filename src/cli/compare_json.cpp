#include "cli/compare_json.h"

#include <nlohmann/json.hpp>

#include "cli/warnings.h"
#include "files/evidence_json.h"
#include "heightlight/version.h"

namespace heightlight {
namespace {

/// Of each AO and form, what the totals err by.
nlohmann::ordered_json describe_answer(const Answer& answer) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const AnswerGroup& group : answer.groups) {
    for (const AnswerLine& line : group.lines) {
      nlohmann::ordered_json errors = nlohmann::ordered_json::array();
      for (std::size_t a = 0; a < line.errors.size(); ++a)
        errors.push_back(
            {{"albedo", answer.albedos[a]}, {"rmse", line.errors[a].rmse}, {"bias", line.errors[a].bias}});
      json.push_back({{"ao", group.role},
                      {"parameters", group.parameters},
                      {"form", line.form},
                      {"outside_domain", line.outside_share},
                      {"errors", errors}});
    }
  }
  return json;
}

nlohmann::ordered_json describe_own_forms(const std::vector<FormOnMap>& forms) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const FormOnMap& own : forms) {
    nlohmann::ordered_json constants = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < own.constants.size(); ++i)
      constants[own.form.expression.constants[i]] = own.constants[i];
    json.push_back({{"name", own.form.name},
                    {"formula", own.form.expression.text},
                    {"constants", constants},
                    {"rmse", own.rms},
                    {"rmse_on_halves_left_out", own.left_out_rms}});
  }
  return json;
}

}  // namespace

std::string comparison_json(const std::filesystem::path& map, const LoadedHeightmap& loaded,
                            const ReportInput& input, const std::vector<FileRecord>& files) {
  const ComparisonReference& reference = input.reference;
  nlohmann::ordered_json json;
  json["version"] = HEIGHTLIGHT_VERSION;
  json["map"] = describe_map(map, loaded.facts.sha256, input.scene.surface);
  json["files"] = describe_files(files);
  json["warnings"] = describe_warnings(loaded.warnings);
  json["answer"] = describe_answer(input.answer);
  json["own_forms"] = describe_own_forms(input.own_forms);
  json["sky"] = {{"quantity", reference.sky.quantity}, {"light", reference.sky.label}};
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

}  // namespace heightlight
