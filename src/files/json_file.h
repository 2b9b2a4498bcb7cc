#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace heightlight {

/// Reads a JSON file: a manifest, or what this program wrote beside its results. Throws Error naming the
/// file: with line and column where the text is not JSON; for a key that appears twice in one object (the
/// parser would keep the last); for files of more than 16 MiB; and for values nested more than 64 deep, which
/// would crash the process.
nlohmann::json read_json(const std::filesystem::path& path);

}  // namespace heightlight
