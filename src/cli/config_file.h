#pragma once

#include <CLI/CLI.hpp>

namespace heightlight {

/// Adds `--config FILE` to every command of the application: TOML with a section per command, whose keys are
/// the names of the command's options. What the command line gives wins. A file of which something is wrong,
/// a key that no option has, ends parsing with a UsageError that names file and line.
void add_config_options(CLI::App& app);

/// The file that was given; empty where none was.
std::string config_file_of(const CLI::App& app);

}  // namespace heightlight
