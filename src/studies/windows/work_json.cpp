#include "windows/work_json.h"

#include <limits>

#include "files/evidence_json.h"
#include "files/output_file.h"
#include "windows/whole_file.h"

namespace heightlight {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const WalkOptions& walk) {
  return {
      {"azimuths", walk.azimuths}, {"fineness", walk.samples_per_octave}, {"peak_share", walk.peak_share}};
}

WalkOptions walk_of(const nlohmann::json& json) {
  return {.azimuths = json.at("azimuths"),
          .samples_per_octave = json.at("fineness"),
          .peak_share = json.at("peak_share")};
}

Json to_json(const FixedSum& sum) { return {sum.whole(), sum.part()}; }

/// JSON knows no infinity, which is written as null: a plan by which no block is walked in full has it.
double finite_or_infinite(const nlohmann::json& json) {
  return json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
}

FixedSum sum_of(const nlohmann::json& json) { return {json.at(0), json.at(1)}; }

}  // namespace

nlohmann::ordered_json to_json(const HorizonPlan& plan) {
  return {{"sky",
           {{"walk", to_json(plan.sky.walk)},
            {"full_from", plan.sky.full_from},
            {"full_share", plan.sky.full_share},
            {"error", plan.sky.error},
            {"sampled", plan.sky.sampled}}},
          {"gather",
           {{"walk", to_json(plan.gather.walk)},
            {"first_bounce_azimuths", plan.gather.first_bounce_azimuths},
            {"error", plan.gather.error},
            {"unevenness", plan.gather.unevenness}}}};
}

HorizonPlan plan_of(const nlohmann::json& json) {
  const nlohmann::json& sky = json.at("sky");
  const nlohmann::json& gather = json.at("gather");
  return {.sky = {.walk = walk_of(sky.at("walk")),
                  .full_from = finite_or_infinite(sky.at("full_from")),
                  .full_share = sky.at("full_share"),
                  .error = sky.at("error"),
                  .sampled = sky.at("sampled")},
          .gather = {.walk = walk_of(gather.at("walk")),
                     .first_bounce_azimuths = gather.at("first_bounce_azimuths"),
                     .error = gather.at("error"),
                     .unevenness = gather.at("unevenness")}};
}

nlohmann::ordered_json to_json(const GatherCourse& course) {
  return {{"kappa", course.kappa},     {"last_azimuths", course.last_azimuths}, {"weight", course.weight},
          {"gathers", course.gathers}, {"azimuths", course.azimuths},           {"kept", course.kept}};
}

GatherCourse course_of(const nlohmann::json& json) {
  return {.kappa = json.at("kappa"),
          .last_azimuths = json.at("last_azimuths"),
          .weight = json.at("weight"),
          .gathers = json.at("gathers"),
          .azimuths = json.at("azimuths"),
          .kept = json.at("kept")};
}

nlohmann::ordered_json to_json(const ChangeSum& change) {
  Json json = {{"squares", to_json(change.squares)}, {"receivers", change.receivers}};
  for (const FixedSum& sum : change.sum) json["sum"].push_back(to_json(sum));
  return json;
}

ChangeSum change_of(const nlohmann::json& json) {
  ChangeSum change{.squares = sum_of(json.at("squares"))};
  json.at("receivers").get_to(change.receivers);
  for (std::size_t k = 0; k < change.sum.size(); ++k) change.sum[k] = sum_of(json.at("sum").at(k));
  return change;
}

void replace_json(const std::filesystem::path& path, const nlohmann::ordered_json& json) {
  write_bytes(unfinished(path), json_text(json));
  appear(path);
}

}  // namespace heightlight
