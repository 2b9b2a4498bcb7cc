#pragma once

#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "heightlight/error.h"

namespace heightlight {

/// "PATH: cannot be written: FAULT". For a file in a staging folder, PATH is where the file would have stood.
OutputError output_error(const std::filesystem::path& path, const std::string& fault);
/// As above, with the system's text for an errno.
OutputError output_error(const std::filesystem::path& path, int error_number);

/// Lets `write` fill the file at `path`, replacing its content, and makes sure that every byte was written.
/// Throws OutputError naming the file and the fault (full disk, unwritable folder).
void write_file(const std::filesystem::path& path, const std::function<void(std::FILE*)>& write);

/// Replaces the content of the file at `path` by these bytes. Throws as write_file does.
void write_bytes(const std::filesystem::path& path, std::string_view bytes);

}  // namespace heightlight
