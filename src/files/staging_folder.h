#pragma once

#include <filesystem>
#include <mutex>

namespace heightlight {

/// A folder in which results wait until they are whole, inside a hidden one, `.heightlight-PID-N`. It goes
/// away with this object, or with the process where that exits without unwinding. What a killed process left
/// is removed by the next that stages in the same place: a file in the hidden folder, `.heightlight-staging`,
/// tells it from folders of other people's that are called alike, and a lock, which ends with its process,
/// from those in use. The file comes first and goes last, and results never lie beside it, so that a kill at
/// any moment leaves either whole results or what the next can tell and remove.
class StagingFolder {
 public:
  /// In `parent`, which exists; what it holds is to stand in `folder`. Throws OutputError, naming `result`,
  /// when it cannot be made there.
  StagingFolder(const std::filesystem::path& parent, const std::filesystem::path& folder,
                const std::filesystem::path& result);
  ~StagingFolder();
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;

  /// Where results wait.
  const std::filesystem::path& path() const { return results_; }

  /// The results become `destination`, on the same file system, at one stroke; false where something stands
  /// there that is no empty folder.
  bool become(const std::filesystem::path& destination);

 private:
  std::filesystem::path path_;  ///< the hidden folder
  std::filesystem::path results_;
  int descriptor_ = -1;  ///< of the hidden folder; holds the lock
};

/// Removes the staging folders in `parent` whose processes are no more. Where locks are unknown, as on some
/// network file systems, nothing is taken for left behind. Folders are told by what they hold, never by name
/// alone. What cannot be removed stays, without an error.
void remove_left_behind(const std::filesystem::path& parent);

/// Where a file that is on its way will stand, for messages; any other path as it is.
std::filesystem::path final_path(const std::filesystem::path& path);

/// Held while results are put in place, so that a late end (see note_interrupts) does not come in between.
std::unique_lock<std::recursive_mutex> hold_off_end();

/// Removes the staging folders of this process and ends it at once.
[[noreturn]] void end_without_staging(int exit_code);

}  // namespace heightlight
