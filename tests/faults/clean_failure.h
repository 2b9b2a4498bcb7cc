#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>
#include <string>

#include "cli/running_command.h"
#include "files/image_file.h"
#include "heightlight/image.h"
#include "scratch_folder.h"

namespace heightlight {

/// Names of everything below a folder, hidden ones included.
inline std::set<std::string> entries_below(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    names.insert(entry.path().lexically_relative(folder).string());
  }
  return names;
}

/// A rough map that simulates in no time.
inline std::filesystem::path write_small_map(const std::filesystem::path& path, int side = 16) {
  Image<std::uint16_t> levels(side, side);
  for (std::size_t i = 0; i < levels.size(); ++i)
    levels.values[i] = static_cast<std::uint16_t>(i * 7919 % 65536);
  write_png16(path, levels);
  return path;
}

/// The command could not do it: exit code 1, one line, and the folder is as it was.
inline void check_failed_cleanly(const ProcessEnd& end, const std::string& error,
                                 const std::filesystem::path& folder, const std::set<std::string>& before) {
  INFO(error);
  CHECK(end.exit_code == 1);
  CHECK(std::count(error.begin(), error.end(), '\n') == 1);
  CHECK_THAT(error, Catch::StartsWith("heightlight: "));
  CHECK((entries_below(folder) == before));
}

}  // namespace heightlight
