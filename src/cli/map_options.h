#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <string>

#include "heightlight/files.h"

namespace heightlight {

/// The options that say how a file becomes a heightmap, as text until they are read.
struct MapOptions {
  std::filesystem::path path;
  LoadOptions load;
};

/// For options that take an unsigned number of 64 bits.
CLI::Validator whole_number();

/// Adds `--relief --height --width --texel --boundary --size --big-endian --scale --offset --no-data --part
/// --channel
/// --shrink --invert --curvature`.
void add_load_options(CLI::App& command, LoadOptions& load);

/// Adds MAP and what add_load_options adds.
void add_map_options(CLI::App& command, MapOptions& options);

/// The options that say how a command runs.
struct RunOptions {
  int threads = 0;           ///< 0: default_threads
  std::uint64_t memory = 0;  ///< bytes of the whole process; apply_run_options leaves those of its work
  std::uint64_t program_memory = 0;  ///< bytes of the rest: code, libraries, stacks
  std::uint64_t seed = 1;
  bool quiet = false;
};

/// Adds `--threads --memory --quiet`.
void add_resource_options(CLI::App& command, RunOptions& options);

/// Adds these, and `--seed`.
void add_run_options(CLI::App& command, RunOptions& options);

/// Sets the number of threads, ours and libraries', and what the work may take: `--memory`, or what of the
/// machine is this process's share by default, less what the program takes by itself.
void apply_run_options(RunOptions& options);

}  // namespace heightlight
