#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/dataset_runs.h"

namespace heightlight {

/// A run that is done, as the report of a dataset tells it.
struct ReportedRun {
  const DatasetRun& run;
  nlohmann::ordered_json summary;
};

/// Writes the report of a dataset of that manifest from the runs that are done, and from those that failed
/// (whose fault is not empty). Throws Error naming curves that cannot be read, OutputError.
void write_dataset_report(const std::filesystem::path& path, const std::vector<ReportedRun>& done,
                          const std::vector<DatasetRun>& runs, const std::filesystem::path& manifest);

}  // namespace heightlight
