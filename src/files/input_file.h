#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "heightlight/error.h"

namespace heightlight {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

using File = std::unique_ptr<std::FILE, CloseFile>;

/// "PATH: FAULT", the form of every message about a file, with the quantity that would help if there is one.
Error file_error(const std::filesystem::path& path, const std::string& fault, const std::string& remedy = "");

/// Opens a file that holds something. Throws Error when it is missing, a directory or a device, empty or
/// unreadable.
File open_input(const std::filesystem::path& path);

}  // namespace heightlight
