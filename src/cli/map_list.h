#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bake/bake.h"

namespace heightlight {

/// The parts of a text between commas.
std::vector<std::string> split_at_commas(const std::string& text);

/// The material map of that name.
std::optional<MaterialMap> find_material_map(const std::string& name);

/// "ao, multibounce, …".
std::string known_material_maps();

}  // namespace heightlight
