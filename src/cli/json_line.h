#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "files/staged_output.h"
#include "heightlight/files.h"

namespace heightlight {

/// Adds `--json`.
void add_json_option(CLI::App& command, bool& json);

/// How work on one map ended, for other programs.
struct MapLine {
  std::filesystem::path map;
  const char* status;                 ///< "done", "skipped" or "failed"
  std::vector<std::string> files;     ///< with their folder
  nlohmann::ordered_json errors;      ///< what the results err by; null where there are none
  std::vector<std::string> warnings;  ///< in words
  std::vector<std::string> removed;   ///< files of an earlier result
  std::string fault;                  ///< why it failed
  double seconds = 0;
};

/// Of a map that ended with an error.
MapLine failed_line(const std::filesystem::path& map, const std::string& fault, double seconds);

/// Names in a folder.
std::vector<std::string> paths_in(const std::filesystem::path& folder, const std::vector<std::string>& names);

/// Warnings in the words of the command line.
std::vector<std::string> warning_texts(const std::vector<Warning>& warnings);

/// One line of JSON on stdout, at once: whoever reads need not wait for the next map.
void print_json_line(const nlohmann::ordered_json& json);
void print_json_line(const MapLine& line);

}  // namespace heightlight
