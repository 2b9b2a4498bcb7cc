#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "heightlight/georeference.h"
#include "heightlight/transport.h"
#include "transport/gather_course.h"

// What a work folder knows between its steps, as JSON: every number comes back to the last bit.

namespace heightlight {

nlohmann::ordered_json to_json(const HorizonPlan& plan);
HorizonPlan plan_of(const nlohmann::json& json);

nlohmann::ordered_json to_json(const GatherCourse& course);
GatherCourse course_of(const nlohmann::json& json);

nlohmann::ordered_json to_json(const ChangeSum& change);
ChangeSum change_of(const nlohmann::json& json);

/// Replaces a file as a whole: who reads it meanwhile sees the old one or the new one. Throws OutputError.
void replace_json(const std::filesystem::path& path, const nlohmann::ordered_json& json);

}  // namespace heightlight
