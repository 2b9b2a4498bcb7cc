#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "cli/map_options.h"
#include "heightlight/sun.h"

namespace heightlight {

/// What `compare --terrain` is told.
struct TerrainOptions {
  bool wanted = false;
  Sun sun;
};

/// Adds `--terrain --sun` and returns the first, which excludes what it has no use for.
CLI::Option* add_terrain_options(CLI::App& command, TerrainOptions& options);

/// A run of it.
struct TerrainRun {
  MapOptions map;
  RunOptions run;
  std::filesystem::path folder;
  std::string albedo;  ///< numbers; empty: those of grass and of snow
  Sun sun;
};

/// Runs the study of terrain and writes terrain.md, its tables, plots and JSON.
void compare_terrain(TerrainRun run);

}  // namespace heightlight
