#include "cli/dataset_locks.h"

#include <algorithm>
#include <string>
#include <system_error>

#include "files/lock_file.h"
#include "files/staging_folder.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLock = ".lock";

/// An empty file called ".NAME-HASH.lock", as runs are.
bool is_lock_of_run(const fs::directory_entry& entry) {
  std::error_code ignored;
  const std::string name = entry.path().filename().string();
  if (!name.starts_with('.') || !name.ends_with(kLock)) return false;
  const std::size_t dash = name.rfind('-');
  if (dash == std::string::npos) return false;
  const std::string hash = name.substr(dash + 1, name.size() - dash - 1 - std::string(kLock).size());
  return hash.size() == kNameDigits && hash.find_first_not_of("0123456789abcdef") == std::string::npos &&
         fs::is_regular_file(entry.symlink_status(ignored)) && entry.file_size(ignored) == 0;
}

}  // namespace

fs::path lock_path(const DatasetRun& run) {
  return run.simulate.folder.parent_path() / ("." + run.name + kLock);
}

fs::path tables_lock_path(const fs::path& folder) { return folder / ".tables.lock"; }

void remove_left_by_killed(const std::vector<DatasetRun>& runs, const fs::path& folder) {
  for (const fs::path& place : {folder, runs_folder(folder), shapes_folder(folder)})
    remove_left_behind(place);
  for (const DatasetRun& run : runs) remove_left_behind(run.simulate.folder);
  std::vector<fs::path> locks;
  std::error_code ignored;
  for (fs::directory_iterator entry(runs_folder(folder), ignored), end; entry != end;
       entry.increment(ignored)) {
    if (is_lock_of_run(*entry)) locks.push_back(entry->path());
  }
  for (const fs::path& lock : locks) LockFile::try_take(lock);  // let go at once, it removes the file
}

}  // namespace heightlight
