#pragma once

#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "heightlight/error.h"

namespace heightlight {

/// "PATH: cannot be written: FAULT"; of a file in a staging folder, the path where it would have stood.
OutputError output_error(const std::filesystem::path& path, const std::string& fault);
/// Likewise of what the system says of an errno.
OutputError output_error(const std::filesystem::path& path, int error_number);

/// Lets `write` fill the file at `path`, replacing what was there, and makes sure that every byte went out.
/// Throws OutputError naming the file and what is wrong (full disk, unwritable folder).
void write_file(const std::filesystem::path& path, const std::function<void(std::FILE*)>& write);

/// Replaces the file at `path` by these bytes; throws likewise.
void write_bytes(const std::filesystem::path& path, std::string_view bytes);

}  // namespace heightlight
