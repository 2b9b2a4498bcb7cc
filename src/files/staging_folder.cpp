#include "files/staging_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <map>
#include <string>
#include <system_error>

#include "files/output_file.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPrefix = ".heightlight-";
constexpr const char* kMarker = ".heightlight-staging";

constexpr const char* kResults = "results";

/// The sticky bit marks the folder while it is empty; the name alone would not distinguish it from other
/// folders.
constexpr mode_t kStagingMode = 0777 | S_ISVTX;

/// Removes the content of the hidden folder, with the marker file last.
void remove_staging(const fs::path& folder) {
  std::error_code ignored;
  for (fs::directory_iterator entry(folder, ignored), end; entry != end; entry.increment(ignored)) {
    if (entry->path().filename() != kMarker) fs::remove_all(entry->path(), ignored);
  }
  fs::remove(folder / kMarker, ignored);
  rmdir(folder.c_str());
}

/// The staging folders of this process. Never destroyed, because the end of the process needs them.
struct Staged {
  std::recursive_mutex mutex;  ///< recursive, because errors found while it is held ask for final paths
  /// from a folder of results to the folder where its content is to stand
  std::map<fs::path, fs::path> folders;
};

void remove_all_staged(const Staged& staged) {
  for (const auto& [results, destination] : staged.folders) remove_staging(results.parent_path());
}

Staged& staged_here() {
  static Staged* const kStaged = [] {
    std::atexit([] {
      const std::lock_guard lock(staged_here().mutex);
      remove_all_staged(staged_here());
    });
    return new Staged;
  }();
  return *kStaged;
}

bool is_staging_name(const std::string& name) {
  if (!name.starts_with(kPrefix)) return false;
  const std::string numbers = name.substr(std::string(kPrefix).size());
  return std::count(numbers.begin(), numbers.end(), '-') == 1 &&
         numbers.find_first_not_of("0123456789-") == std::string::npos;
}

int open_folder(const fs::path& folder) {
  return open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

/// Writes the marker file, which only this program writes, and only into staging folders.
bool write_marker(int folder) {
  const int marker = openat(folder, kMarker, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (marker < 0) return false;
  close(marker);
  return true;
}

/// Whether a folder is a staging folder: it contains the marker file, or is empty and has the sticky bit.
bool is_marked(int folder, const fs::path& path) {
  struct stat status {};
  if (fstatat(folder, kMarker, &status, AT_SYMLINK_NOFOLLOW) == 0) return S_ISREG(status.st_mode);
  std::error_code failure;
  return fstat(folder, &status) == 0 && (status.st_mode & S_ISVTX) != 0 && fs::is_empty(path, failure);
}

/// Takes the lock of a folder that was just made; false if another process removed the folder in between.
bool lock_new_folder(int descriptor, const fs::path& folder) {
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
  struct stat opened {};
  struct stat named {};
  return fstat(descriptor, &opened) == 0 && stat(folder.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

}  // namespace

StagingFolder::StagingFolder(const fs::path& parent, const fs::path& folder, const fs::path& result) {
  remove_left_behind(parent);
  Staged& staged = staged_here();
  const std::string stem = kPrefix + std::to_string(getpid()) + "-";
  constexpr int kMostTries = 10000;
  int fault = EEXIST;
  for (int i = 0; i < kMostTries; ++i) {
    const fs::path candidate = parent / (stem + std::to_string(i));
    const std::lock_guard lock(staged.mutex);
    if (mkdir(candidate.c_str(), kStagingMode) != 0) {
      fault = errno;
      if (fault == EEXIST) continue;
      break;
    }
    descriptor_ = open_folder(candidate);
    fault = descriptor_ < 0 ? errno : 0;
    if (fault == 0 && lock_new_folder(descriptor_, candidate)) {
      const fs::path results = candidate / kResults;
      if (write_marker(descriptor_) && mkdir(results.c_str(), 0777) == 0) {
        path_ = candidate;
        results_ = results;
        staged.folders.emplace(results_, folder);
        return;
      }
      fault = errno;
      unlinkat(descriptor_, kMarker, 0);
    }
    if (descriptor_ >= 0) close(descriptor_);
    descriptor_ = -1;
    rmdir(candidate.c_str());
    if (fault != 0) break;  // otherwise another process took it for left behind; try the next name
  }
  throw output_error(result, fault);
}

StagingFolder::~StagingFolder() {
  remove_staging(path_);
  const std::lock_guard lock(staged_here().mutex);
  staged_here().folders.erase(results_);
  close(descriptor_);
}

bool StagingFolder::become(const fs::path& destination) {
  return rename(results_.c_str(), destination.c_str()) == 0;
}

void remove_left_behind(const fs::path& parent) {
  std::error_code ignored;
  for (fs::directory_iterator entry(parent, ignored), end; entry != end; entry.increment(ignored)) {
    if (!is_staging_name(entry->path().filename().string())) continue;
    const int descriptor = open_folder(entry->path());
    if (descriptor < 0) continue;
    // The lock is taken first, because a process that has just begun may not have marked its folder yet.
    if (flock(descriptor, LOCK_EX | LOCK_NB) == 0 && is_marked(descriptor, entry->path()))
      remove_staging(entry->path());
    close(descriptor);
  }
}

fs::path final_path(const fs::path& path) {
  const std::lock_guard lock(staged_here().mutex);
  const auto found = staged_here().folders.find(path.parent_path());
  return found == staged_here().folders.end() ? path : found->second / path.filename();
}

std::unique_lock<std::recursive_mutex> hold_off_end() { return std::unique_lock(staged_here().mutex); }

void end_without_staging(int exit_code) {
  staged_here().mutex.lock();  // never unlocked: nothing is put in place any more
  remove_all_staged(staged_here());
  _exit(exit_code);
}

}  // namespace heightlight
