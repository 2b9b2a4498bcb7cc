#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "scratch_folder.h"

namespace heightlight {

/// Everything below a folder: names, hidden ones included, and what files hold. Of a run's summary.json that
/// is all but what differs from one making to the next; of a dataset's costs.csv, nothing.
inline std::map<std::string, std::string> folder_contents(const std::filesystem::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    std::string& content = contents[name];
    if (!entry.is_regular_file() || entry.path().filename() == "costs.csv") continue;
    content = read_text(entry.path());
    if (entry.path().filename() != "summary.json") continue;
    nlohmann::json summary = nlohmann::json::parse(content);
    summary.erase("time_s");
    summary.erase("memory");
    summary.erase("key");
    summary["map"].erase("path");
    content = summary.dump();
  }
  return contents;
}

}  // namespace heightlight
