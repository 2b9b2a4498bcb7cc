#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "heightlight/files.h"

namespace heightlight {

/// The value, or null where there is none.
template <class T>
nlohmann::ordered_json or_null(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

/// How a file becomes heights, as part of what results depend on.
nlohmann::ordered_json describe_load_options(const LoadOptions& load);

/// Of such a description: SHA-256, hexadecimal.
std::string request_key(const nlohmann::ordered_json& request);

}  // namespace heightlight
