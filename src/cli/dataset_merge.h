#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/dataset_runs.h"

namespace heightlight {

/// What becomes one dataset: the runs of a manifest that are done in its folder, and in others.
struct MergeFolders {
  std::filesystem::path folder;               ///< gets the tables, and the runs that only others have
  std::vector<std::filesystem::path> others;  ///< are read
  bool report = false;                        ///< write report.html, too
};

/// Takes in what others hold and writes the tables. Merging once more changes no byte. Returns how many runs
/// were taken in. Throws Error, before anything is written, naming a folder of another origin
/// (describe_origin), or saying which runs are missing: those that are done nowhere, and those that failed;
/// OutputError, Cancelled.
std::ptrdiff_t merge_runs(const nlohmann::ordered_json& origin, const std::vector<DatasetRun>& runs,
                          const MergeFolders& folders, const std::vector<std::filesystem::path>& inputs);

}  // namespace heightlight
