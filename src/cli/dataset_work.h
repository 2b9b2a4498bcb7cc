#pragma once

#include <filesystem>
#include <vector>

#include "cli/dataset_runs.h"
#include "cli/plots.h"

namespace heightlight {

/// Throws OutputError where the folder and its parents cannot be made.
void make_folder(const std::filesystem::path& folder);

/// Tells why a run could not be done.
void tell_fault(const DatasetRun& run);

/// Does the runs in their order, beside any number of processes that may be at work in the same dataset. A
/// run that another is busy with waits until this process has nothing else to do, and until the other has
/// done it or is no more. Notes and tells the fault of each that fails. Throws OutputError where no run could
/// be written, Cancelled.
void do_runs(const std::vector<DatasetRun*>& runs, const std::vector<std::filesystem::path>& inputs,
             Plots& plots, bool quiet);

}  // namespace heightlight
