#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/manifest.h"

namespace heightlight {

/// Of a dataset's folder, beside its tables.
constexpr const char* kOriginFile = "origin.json";

/// What the results of a dataset come from beside the inputs: this version, and the manifest by what it holds
/// now. dataset.json begins so. Throws Error naming the manifest.
nlohmann::ordered_json describe_origin(const Manifest& manifest);

/// Leaves the origin in the folder, in its kOriginFile, for check_origin. Throws OutputError, and UsageError
/// where it would replace an input.
void write_origin(const nlohmann::ordered_json& origin, const std::filesystem::path& folder,
                  const std::vector<std::filesystem::path>& inputs);

/// Throws Error naming the folder unless a process of this version has worked there last, for a manifest that
/// holds the same. Under which name it did matters nothing.
void check_origin(const nlohmann::ordered_json& origin, const std::filesystem::path& folder);

}  // namespace heightlight
