#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace heightlight {

/// Reads a file of JSON: a manifest, or what this program wrote beside its results. Throws Error naming it,
/// with line and column where the text is no JSON, and for a key that stands twice in one object (of which
/// the parser would keep the last), for more than 16 MiB, and for values more than 64 deep, which would end
/// the process.
nlohmann::json read_json(const std::filesystem::path& path);

}  // namespace heightlight
