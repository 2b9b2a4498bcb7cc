#include "cli/json_line.h"

#include <cstdio>

#include "cli/warnings.h"

namespace heightlight {

void add_json_option(CLI::App& command, bool& json) {
  command.add_flag(
      "--json", json,
      "print one line of JSON per map to standard output (files, errors, seconds), instead of the summary");
}

MapLine failed_line(const std::filesystem::path& map, const std::string& fault, double seconds) {
  return {.map = map,
          .status = "failed",
          .files = {},
          .errors = {},
          .warnings = {},
          .removed = {},
          .fault = fault,
          .seconds = seconds};
}

std::vector<std::string> paths_in(const std::filesystem::path& folder,
                                  const std::vector<std::string>& names) {
  std::vector<std::string> paths;
  for (const std::string& name : names) paths.push_back((folder / name).string());
  return paths;
}

std::vector<std::string> warning_texts(const std::vector<Warning>& warnings) {
  std::vector<std::string> texts;
  for (const Warning& warning : warnings) texts.push_back(user_message(warning));
  return texts;
}

void print_json_line(const nlohmann::ordered_json& json) {
  constexpr int kOneLine = -1;
  const std::string line =
      json.dump(kOneLine, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
  std::fputs(line.c_str(), stdout);
  std::fflush(stdout);
}

void print_json_line(const MapLine& line) {
  nlohmann::ordered_json json = {{"map", line.map.string()}, {"status", line.status}};
  if (!line.fault.empty()) json["error"] = line.fault;
  json["files"] = line.files;
  json["errors"] = line.errors;
  json["warnings"] = line.warnings;
  json["removed"] = line.removed;
  json["seconds"] = line.seconds;
  print_json_line(json);
}

}  // namespace heightlight
