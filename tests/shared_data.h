#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <optional>
#include <string>

namespace heightlight {

/// A real map that is not part of the repository. Where it is absent the test says so loudly, and has nothing
/// to check:
///     const auto path = find_shared_data("terrain/lakes_dem.tif");
///     if (!path) return;
inline std::optional<std::filesystem::path> find_shared_data(const std::string& name) {
  const std::filesystem::path path = std::filesystem::path(HEIGHTLIGHT_SHARED_DIR) / "data" / name;
  if (std::filesystem::exists(path)) return path;
  WARN("SKIPPED: shared data absent: " << path.string());
  return std::nullopt;
}

}  // namespace heightlight
