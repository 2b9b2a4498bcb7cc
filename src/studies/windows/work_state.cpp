#include <system_error>

#include "files/input_file.h"
#include "files/json_file.h"
#include "heightlight/version.h"
#include "windows/work.h"
#include "windows/work_json.h"

namespace heightlight {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kStateFile = "work.json";

Json to_json(const Georeference& place) {
  Json tags = Json::array();
  for (const GeoTag& tag : place.tags)
    tags.push_back({{"number", tag.number},
                    {"type", tag.type},
                    {"bytes", std::vector<int>(tag.bytes.begin(), tag.bytes.end())}});
  Json json = {{"cell", {place.cell.x, place.cell.y}},
               {"in_degrees", place.in_degrees},
               {"system", place.system},
               {"projection", place.projection},
               {"tags", tags}};
  if (place.corner) json["corner"] = *place.corner;
  if (place.metres) json["metres"] = *place.metres;
  if (place.height_metres) json["height_metres"] = *place.height_metres;
  if (place.equator_radius) json["equator_radius"] = *place.equator_radius;
  return json;
}

template <class T>
std::optional<T> optional_of(const nlohmann::json& json, const char* key) {
  return json.contains(key) ? std::optional<T>(json.at(key).get<T>()) : std::nullopt;
}

Georeference place_of(const nlohmann::json& json) {
  Georeference place{.corner = optional_of<std::array<double, 2>>(json, "corner"),
                     .cell = {json.at("cell").at(0), json.at("cell").at(1)},
                     .in_degrees = json.at("in_degrees"),
                     .metres = optional_of<double>(json, "metres"),
                     .height_metres = optional_of<double>(json, "height_metres"),
                     .equator_radius = optional_of<double>(json, "equator_radius"),
                     .system = json.at("system"),
                     .projection = json.at("projection")};
  for (const nlohmann::json& tag : json.at("tags")) {
    const std::vector<int> bytes = tag.at("bytes");
    place.tags.push_back({tag.at("number"), tag.at("type"), std::string(bytes.begin(), bytes.end())});
  }
  return place;
}

Json to_json(const WorkFacts& facts) {
  Json json = {{"request", facts.request},
               {"grid", {facts.grid.map_width, facts.grid.map_height, facts.grid.side}},
               {"first_coarse", facts.first_coarse},
               {"base", facts.base},
               {"spacing", {facts.spacing.x, facts.spacing.y}},
               {"tiles", facts.boundary == Boundary::tile},
               {"curvature", facts.curvature},
               {"lowest", facts.lowest},
               {"highest", facts.highest},
               {"missing", facts.missing},
               {"sha256", facts.sha256},
               {"warnings", Json::array()}};
  if (facts.place) json["place"] = to_json(*facts.place);
  for (const Warning& warning : facts.warnings) json["warnings"].push_back({warning.message, warning.remedy});
  return json;
}

WorkFacts facts_of(const nlohmann::json& json) {
  const nlohmann::json& grid = json.at("grid");
  WorkFacts facts{.request = json.at("request"),
                  .grid = {grid.at(0), grid.at(1), grid.at(2)},
                  .first_coarse = json.at("first_coarse"),
                  .base = json.at("base"),
                  .spacing = {json.at("spacing").at(0), json.at("spacing").at(1)},
                  .boundary = json.at("tiles") ? Boundary::tile : Boundary::open,
                  .curvature = json.at("curvature"),
                  .lowest = json.at("lowest"),
                  .highest = json.at("highest"),
                  .missing = json.at("missing"),
                  .sha256 = json.at("sha256")};
  if (json.contains("place")) facts.place = place_of(json.at("place"));
  for (const nlohmann::json& warning : json.at("warnings"))
    facts.warnings.push_back({warning.at(0), warning.at(1)});
  return facts;
}

WorkState state_of(const nlohmann::json& json) {
  WorkState state{.facts = facts_of(json.at("facts")),
                  .step = static_cast<WorkStep>(json.at("step").get<int>()),
                  .gather = json.at("gather")};
  if (json.contains("plan")) state.plan = plan_of(json.at("plan"));
  if (json.contains("refined_plan")) state.refined_plan = plan_of(json.at("refined_plan"));
  json.at("refined").get_to(state.refined);
  json.at("share").get_to(state.share);
  for (const nlohmann::json& course : json.at("courses")) state.courses.push_back(course_of(course));
  json.at("class_sample").get_to(state.class_sample);
  return state;
}

}  // namespace

std::optional<WorkState> read_state(const std::filesystem::path& folder) {
  std::error_code ignored;
  const std::filesystem::path path = folder / kStateFile;
  if (!std::filesystem::exists(path, ignored)) return std::nullopt;
  const nlohmann::json json = read_json(path);
  if (!json.contains("version") || json["version"] != HEIGHTLIGHT_VERSION) return std::nullopt;
  try {
    return state_of(json);
  } catch (const nlohmann::json::exception& fault) {
    throw file_error(path, std::string("is damaged: ") + fault.what());
  }
}

void write_state(const std::filesystem::path& folder, const WorkState& state) {
  Json json = {{"version", HEIGHTLIGHT_VERSION},
               {"facts", to_json(state.facts)},
               {"step", static_cast<int>(state.step)},
               {"gather", state.gather},
               {"refined", state.refined},
               {"share", state.share},
               {"courses", Json::array()},
               {"class_sample", state.class_sample}};
  if (state.plan) json["plan"] = to_json(*state.plan);
  if (state.refined_plan) json["refined_plan"] = to_json(*state.refined_plan);
  for (const GatherCourse& course : state.courses) json["courses"].push_back(to_json(course));
  replace_json(folder / kStateFile, json);
}

}  // namespace heightlight
