#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/map_options.h"

namespace heightlight {

/// What `compare --specular` is told.
struct SpecularCompareOptions {
  bool wanted = false;
  std::string roughness = "0.02,0.13,0.4";
  std::vector<std::string> views = {"65,90", "65,45", "65,20"};
  std::filesystem::path table = {};  ///< of GTSO, to be tried beside our own; empty: none
};

/// Adds `--specular --roughness --view --table` and returns the first.
CLI::Option* add_specular_options(CLI::App& command, SpecularCompareOptions& options);

/// Adds `--directional` and returns it.
CLI::Option* add_directional_option(CLI::App& command, bool& wanted);

/// Runs of them.
struct SpecularRun {
  MapOptions map;
  RunOptions run;
  std::filesystem::path folder;
  SpecularCompareOptions specular;
};
struct DirectionalRun {
  MapOptions map;
  RunOptions run;
  std::filesystem::path folder;
  std::filesystem::path sky;  ///< of one's own, to be tried beside ours; empty: none
};

/// Each runs its study and writes a report, tables, a picture and JSON.
void compare_specular(SpecularRun run);
void compare_directional(DirectionalRun run);

}  // namespace heightlight
