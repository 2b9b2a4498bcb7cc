#pragma once

#include <filesystem>
#include <vector>

#include "cli/dataset_runs.h"

namespace heightlight {

/// Where a LockFile keeps a run to one process, beside its folder: `runs/.NAME.lock`.
std::filesystem::path lock_path(const DatasetRun& run);

/// Likewise for the tables of a dataset: no process mixes its own with another's.
std::filesystem::path tables_lock_path(const std::filesystem::path& folder);

/// Removes from the dataset's folder what processes left that were killed: staging folders and locks. What
/// living processes use stays.
void remove_left_by_killed(const std::vector<DatasetRun>& runs, const std::filesystem::path& folder);

}  // namespace heightlight
