#pragma once

#include <CLI/CLI.hpp>

namespace heightlight {

/// Each adds its subcommand, with options, help and examples, to the application. The subcommand's callback
/// does the work and throws Error, UsageError or Cancelled.
void add_info_command(CLI::App& app);
void add_synth_command(CLI::App& app);
void add_specular_table_command(CLI::App& app);
void add_simulate_command(CLI::App& app);
void add_bake_command(CLI::App& app);
void add_dataset_command(CLI::App& app);
void add_compare_command(CLI::App& app);
void add_fit_command(CLI::App& app);
void add_shaders_command(CLI::App& app);
void add_completion_command(CLI::App& app);

}  // namespace heightlight
