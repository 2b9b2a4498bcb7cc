#pragma once

#include <cstdio>
#include <filesystem>
#include <functional>
#include <string_view>

namespace heightlight {

/// Lets `write` fill the file at `path`, replacing what was there, and makes sure that every byte went out.
/// Throws Error naming the file and what is wrong (full disk, unwritable folder).
void write_file(const std::filesystem::path& path, const std::function<void(std::FILE*)>& write);

/// Replaces the file at `path` by these bytes; throws likewise.
void write_bytes(const std::filesystem::path& path, std::string_view bytes);

}  // namespace heightlight
