#pragma once

#include <filesystem>
#include <mutex>

namespace heightlight {

/// A hidden folder, `.heightlight-PID-N`, in which results wait until they are whole. It goes away with this
/// object, or with the process where that exits without unwinding. What a killed process left is removed by
/// the next that stages in the same place: a file in it, `.heightlight-staging`, tells it from folders of
/// other people's that are called alike, and a lock, which ends with its process, from those in use.
class StagingFolder {
 public:
  /// In `parent`, which exists; what it holds is to stand in `folder`. Throws OutputError, naming `result`,
  /// when it cannot be made there.
  StagingFolder(const std::filesystem::path& parent, const std::filesystem::path& folder,
                const std::filesystem::path& result);
  ~StagingFolder();
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Becomes `destination`, on the same file system, at one stroke; false where something stands there that
  /// is no empty folder.
  bool become(const std::filesystem::path& destination);

 private:
  void forget();

  std::filesystem::path path_;  ///< empty once it became something else
  int descriptor_ = -1;         ///< holds the lock
};

/// Where a file that is on its way will stand, for messages; any other path as it is.
std::filesystem::path final_path(const std::filesystem::path& path);

/// Held while results are put in place, so that a late end (see note_interrupts) does not come in between.
std::unique_lock<std::recursive_mutex> hold_off_end();

/// Removes the staging folders of this process and ends it at once.
[[noreturn]] void end_without_staging(int exit_code);

}  // namespace heightlight
