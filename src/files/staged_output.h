#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "files/file_record.h"
#include "files/staging_folder.h"

namespace heightlight {

/// Input files, which no result may replace. Copies share their data.
class InputGuard {
 public:
  /// Paths at which there is no file, such as an albedo that is a number, are not inputs.
  InputGuard(const std::vector<std::filesystem::path>& inputs);  // NOLINT(google-explicit-constructor)
  InputGuard(std::initializer_list<std::filesystem::path> inputs = {})
      : InputGuard(std::vector<std::filesystem::path>(inputs)) {}

  /// Throws UsageError naming the input that a result at `destination` would replace. Files are compared by
  /// device and inode, whatever their names.
  void check(const std::filesystem::path& destination) const;

  /// The input that a path leads to; nullptr where it leads to none.
  const std::filesystem::path* find(const std::filesystem::path& destination) const;

 private:
  using Identity = std::pair<std::uint64_t, std::uint64_t>;  ///< device and inode
  std::shared_ptr<const std::map<Identity, std::filesystem::path>> inputs_;
};

/// Describes what an earlier result of the same kind left in a folder. The next result removes those files
/// that it does not write itself: files that the earlier record lists, if their names are ones that such
/// results have.
struct FormerRecord {
  std::string file = {};    ///< JSON file with the key `files` (read_file_records); empty: nothing is known
  std::string prefix = {};  ///< names that begin with this, besides those that the new result may write
};

/// A folder of results that appears whole or not at all. Files are written into a hidden staging folder on
/// the same file system and synced. If the folder is new, `commit` renames the staging folder to it, so that
/// it appears with all its files at once. If the folder exists, `commit` renames each file into it, in the
/// order in which they were asked for; the presence of the last file shows that all are there. Files that the
/// record of an earlier result lists and this one lacks are removed. Without `commit`, the destructor removes
/// every trace, including parent folders that this object created.
class StagedFolder {
 public:
  /// Creates the parents of `folder` where absent. `record` names the JSON file in the folder that lists the
  /// other files (read_file_records); it is empty where there is none. `results` are the names of the files
  /// to be written. Throws UsageError naming an input that one of `results` would replace, whatever their
  /// names (compared by device and inode). Throws Error naming the folder when it can't be created or written
  /// to, exists and is not a folder, or cannot hold a file with such a long name.
  StagedFolder(std::filesystem::path folder, InputGuard inputs, const std::vector<std::string>& results,
               FormerRecord record = {});
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// Where to write the file that will be called `name` in the folder. Names have no folder part. Throws
  /// Error when something other than a regular file already has that name, UsageError when an input has it.
  std::filesystem::path file(const std::string& name);

  /// Cancels an earlier call of file() for that name.
  void leave_out(const std::string& name);

  /// Where that file will stand, for messages.
  std::filesystem::path final_path(const std::string& name) const { return folder_ / name; }

  /// Records of the files written so far, in order. Throws Error.
  std::vector<FileRecord> written() const;

  /// Puts every staged file in its place. Returns the names of the removed files of an earlier result. Throws
  /// Error naming a file that could not be put in place.
  std::vector<std::string> commit();

 private:
  void put_in_place();
  std::vector<std::string> remove_former();

  std::filesystem::path folder_;
  InputGuard inputs_;
  std::filesystem::path first_created_;  ///< topmost parent that did not exist before; empty if all did
  bool is_new_ = false;                  ///< whether the staging folder is to become the folder
  std::unique_ptr<StagingFolder> staging_;
  std::vector<std::string> names_;
  FormerRecord record_;
  std::vector<FileRecord> former_;  ///< files of the result that was there before
  bool committed_ = false;
};

/// As StagedFolder, for a single result file: write to `path()`, then `commit()`.
class StagedFile {
 public:
  /// Throws Error when the folder of `destination` is absent or can't be written to, or `destination` exists
  /// and is not a regular file; UsageError when it is one of the inputs.
  explicit StagedFile(std::filesystem::path destination,
                      const std::vector<std::filesystem::path>& inputs = {});

  /// Where to write it; it keeps the destination's name, whose extension chooses the format.
  const std::filesystem::path& path() const { return staged_; }

  /// Puts the file in its place. Throws Error naming it when that fails.
  void commit();

 private:
  std::filesystem::path destination_;
  std::unique_ptr<StagingFolder> staging_;  ///< beside the destination
  std::filesystem::path staged_;            ///< the only file in the staging folder
};

}  // namespace heightlight
