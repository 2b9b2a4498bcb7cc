#include "cli/dataset_merge.h"

#include <algorithm>
#include <optional>
#include <string>
#include <system_error>

#include "cli/dataset_locks.h"
#include "cli/dataset_origin.h"
#include "cli/dataset_tables.h"
#include "cli/dataset_work.h"
#include "files/file_record.h"
#include "files/input_file.h"
#include "files/interrupt.h"
#include "files/lock_file.h"
#include "files/output_file.h"
#include "files/staged_output.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;

void check_folders(const nlohmann::ordered_json& origin, const MergeFolders& folders) {
  for (const fs::path& other : folders.others) check_origin(origin, other);
  // Runs that others made may go into a folder that is new.
  std::error_code ignored;
  const bool is_new = !fs::exists(runs_folder(folders.folder), ignored);
  if (folders.others.empty() || !is_new) check_origin(origin, folders.folder);
}

/// The same run, done elsewhere.
DatasetRun moved(DatasetRun run, const fs::path& folder) {
  run.simulate.folder = runs_folder(folder) / run.name;
  return run;
}

/// Whether all its results are there. Plots are no part of the tables, and not every machine draws them.
bool is_whole(const DatasetRun& run) { return is_done(run, false); }

/// The folder of the dataset that has the run; nothing where none has.
std::optional<fs::path> find_run(const DatasetRun& run, const MergeFolders& folders) {
  if (is_whole(run)) return folders.folder;
  for (const fs::path& other : folders.others) {
    if (is_whole(moved(run, other))) return other;
  }
  return std::nullopt;
}

[[noreturn]] void refuse_incomplete(const std::vector<const DatasetRun*>& missing, std::size_t all,
                                    const fs::path& folder) {
  constexpr std::size_t kMostNamed = 3;
  std::string names;
  for (std::size_t i = 0; i < std::min(kMostNamed, missing.size()); ++i)
    names += (i == 0 ? "" : ", ") + missing[i]->name;
  if (missing.size() > kMostNamed) names += ", …";
  throw file_error(folder, std::to_string(missing.size()) + " of " + std::to_string(all) +
                               " runs are missing, and no tables are written: " + names);
}

/// Puts a copy of the run's results where they belong, unless another process has done so meanwhile.
void take_in(const DatasetRun& run, const fs::path& other) {
  const auto lock = LockFile::take(lock_path(run));
  if (is_whole(run)) return;
  const fs::path source = moved(run, other).simulate.folder;
  std::vector<std::string> names;
  for (const FileRecord& file :
       read_file_records(source / "summary.json").value_or(std::vector<FileRecord>{}))
    names.push_back(file.name);
  names.emplace_back("summary.json");  // last: it says that all are there
  StagedFolder staged(run.simulate.folder, *run.simulate.inputs, names,
                      {.file = "summary.json", .prefix = "irradiance_"});
  for (const std::string& name : names) {
    throw_if_interrupted();
    std::error_code failure;
    fs::copy_file(source / name, staged.file(name), failure);
    if (failure) throw output_error(staged.file(name), failure.message());
  }
  staged.commit();
  if (!is_whole(run)) throw file_error(source, "was changed while it was copied");
}

}  // namespace

std::ptrdiff_t merge_runs(const nlohmann::ordered_json& origin, const std::vector<DatasetRun>& runs,
                          const MergeFolders& folders, const std::vector<fs::path>& inputs) {
  check_folders(origin, folders);
  std::vector<fs::path> places;
  std::vector<const DatasetRun*> missing;
  for (const DatasetRun& run : runs) {
    const std::optional<fs::path> place = run.fault.empty() ? find_run(run, folders) : std::nullopt;
    if (!run.fault.empty()) tell_fault(run);
    if (!place) missing.push_back(&run);
    places.push_back(place.value_or(fs::path()));
  }
  if (!missing.empty()) refuse_incomplete(missing, runs.size(), folders.folder);
  make_folder(runs_folder(folders.folder));
  remove_left_by_killed(runs, folders.folder);
  write_origin(origin, folders.folder, inputs);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (places[i] != folders.folder) take_in(runs[i], places[i]);
  }
  write_tables(origin, runs, folders.folder, inputs, folders.report);
  return std::count_if(places.begin(), places.end(),
                       [&](const fs::path& place) { return place != folders.folder; });
}

}  // namespace heightlight
