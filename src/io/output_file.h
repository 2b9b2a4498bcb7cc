#pragma once

#include <filesystem>
#include <string_view>

namespace heightlight {

/// Replaces the file at `path` by these bytes. Throws Error naming it and what is wrong (full disk,
/// unwritable folder).
void write_bytes(const std::filesystem::path& path, std::string_view bytes);

}  // namespace heightlight
