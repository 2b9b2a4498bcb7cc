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

/// Adds `--relief --width --texel --boundary --size --big-endian --scale --offset --no-data --part --channel
/// --shrink --invert --curvature`.
void add_load_options(CLI::App& command, LoadOptions& load);

/// Adds MAP and what add_load_options adds.
void add_map_options(CLI::App& command, MapOptions& options);

/// The options that say how a command runs.
struct RunOptions {
  int threads = 0;           ///< 0: one per processor
  std::uint64_t memory = 0;  ///< bytes; set by apply_run_options where the user did not
  std::uint64_t seed = 1;
  bool quiet = false;
};

/// Adds `--threads --memory --quiet`.
void add_resource_options(CLI::App& command, RunOptions& options);

/// Adds these, and `--seed`.
void add_run_options(CLI::App& command, RunOptions& options);

/// Sets the number of threads, and the default for `--memory`: four fifths of what the machine can still
/// give.
void apply_run_options(RunOptions& options);

}  // namespace heightlight
