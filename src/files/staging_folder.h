#pragma once

#include <filesystem>
#include <mutex>

namespace heightlight {

/// A folder in which results wait until they are complete, inside a hidden folder, `.heightlight-PID-N`. It
/// is removed with this object, or when the process exits without unwinding. Folders left by a killed process
/// are removed by the next process that stages in the same parent. The hidden folder contains a file
/// `.heightlight-staging`, which distinguishes it from folders of other origin with a similar name; a lock,
/// which ends with its process, distinguishes folders in use. That file is created first and removed last,
/// and results never lie beside it. Hence a kill at any moment leaves either complete results or something
/// that the next process recognises and removes.
class StagingFolder {
 public:
  /// Makes a staging folder in `parent`, which must exist; its content is to stand in `folder` later. Throws
  /// OutputError naming `result` when the folder cannot be made.
  StagingFolder(const std::filesystem::path& parent, const std::filesystem::path& folder,
                const std::filesystem::path& result);
  ~StagingFolder();
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;

  /// Where results wait.
  const std::filesystem::path& path() const { return results_; }

  /// Renames the folder of results to `destination`, on the same file system, in one step. Returns false
  /// where something other than an empty folder stands there.
  bool become(const std::filesystem::path& destination);

 private:
  std::filesystem::path path_;  ///< the hidden folder
  std::filesystem::path results_;
  int descriptor_ = -1;  ///< open hidden folder; holds the lock
};

/// Removes the staging folders in `parent` whose processes have ended. Where the file system does not support
/// locks, as on some network file systems, no folder is considered left behind. Folders are recognised by
/// their content, never by name alone. What cannot be removed stays, without an error.
void remove_left_behind(const std::filesystem::path& parent);

/// Where a staged file will stand, for messages; any other path is returned unchanged.
std::filesystem::path final_path(const std::filesystem::path& path);

/// Held while results are put in place, so that a late end (see note_interrupts) does not interrupt that.
std::unique_lock<std::recursive_mutex> hold_off_end();

/// Removes the staging folders of this process and ends the process at once.
[[noreturn]] void end_without_staging(int exit_code);

}  // namespace heightlight
