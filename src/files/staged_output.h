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

/// Files that are read, which no result may replace. Copies share what they know.
class InputGuard {
 public:
  /// Paths at which there is nothing, such as an albedo that is a number, name no input.
  InputGuard(const std::vector<std::filesystem::path>& inputs);  // NOLINT(google-explicit-constructor)
  InputGuard(std::initializer_list<std::filesystem::path> inputs = {})
      : InputGuard(std::vector<std::filesystem::path>(inputs)) {}

  /// Throws UsageError naming the input that a result at `destination` would replace, whatever it is called
  /// there and here: the same file by device and inode.
  void check(const std::filesystem::path& destination) const;

  /// The input that a path leads to; nullptr where it leads to none.
  const std::filesystem::path* find(const std::filesystem::path& destination) const;

 private:
  using Identity = std::pair<std::uint64_t, std::uint64_t>;  ///< device and inode
  std::shared_ptr<const std::map<Identity, std::filesystem::path>> inputs_;
};

/// What an earlier result of the same kind left in a folder, and the next takes away where it does not write
/// it: files that its record lists, under names that such results have.
struct FormerRecord {
  std::string file = {};    ///< of JSON, with the key `files` (read_file_records); empty: nothing is known
  std::string prefix = {};  ///< beside the names that the new result may write: all that begin so
};

/// A folder of results that appears whole or not at all. Files are written into a hidden staging folder on
/// the same file system and synced. Where the folder is new, `commit` gives it its name: it is there with all
/// its files, or not at all. Where it exists, `commit` renames file after file into it, in the order in which
/// they were asked for, and the last to come says that all are there; what the record of an earlier result
/// lists and this one has not, goes away. Without `commit`, the destructor removes every trace, parent
/// folders that this object created included.
class StagedFolder {
 public:
  /// Creates the parents of `folder` where absent. `record` names the file of JSON in it that lists the
  /// others (read_file_records); empty where none does. Throws UsageError naming an input that one of
  /// `results`, names of files in the folder, would replace, whatever it is called there and here (the same
  /// file by device and inode); Error naming the folder when it can't be created or written to, exists and is
  /// no folder, or cannot hold a file of such a long name.
  StagedFolder(std::filesystem::path folder, InputGuard inputs, const std::vector<std::string>& results,
               FormerRecord record = {});
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// Where to write the file that will be called `name` in the folder. Names have no folder part. Throws
  /// Error when something other than a regular file has that name already, UsageError when an input has it.
  std::filesystem::path file(const std::string& name);

  /// Takes back that there will be such a file.
  void leave_out(const std::string& name);

  /// Where that file will stand: for messages.
  std::filesystem::path final_path(const std::string& name) const { return folder_ / name; }

  /// What has been written so far, in order, for the record. Throws Error.
  std::vector<FileRecord> written() const;

  /// Puts every staged file in its place. Returns the names of files of an earlier result that went away.
  /// Throws Error naming the file that could not be put there.
  std::vector<std::string> commit();

 private:
  void put_in_place();
  std::vector<std::string> remove_former();

  std::filesystem::path folder_;
  InputGuard inputs_;
  std::filesystem::path first_created_;  ///< topmost parent that did not exist before; empty if all did
  bool is_new_ = false;                  ///< the staging folder is to become the folder
  std::unique_ptr<StagingFolder> staging_;
  std::vector<std::string> names_;
  FormerRecord record_;
  std::vector<FileRecord> former_;  ///< of the result that was there
  bool committed_ = false;
};

/// One result file, likewise: write to `path()`, then `commit()`.
class StagedFile {
 public:
  /// Throws Error when the folder of `destination` is absent or can't be written to, or `destination` exists
  /// and is not a regular file; UsageError when it is one of the inputs.
  explicit StagedFile(std::filesystem::path destination,
                      const std::vector<std::filesystem::path>& inputs = {});

  /// Where to write it; it keeps the destination's name, whose extension chooses the format.
  const std::filesystem::path& path() const { return staged_; }

  /// Puts the file in its place. Throws Error naming it when that can't be done.
  void commit();

 private:
  std::filesystem::path destination_;
  std::unique_ptr<StagingFolder> staging_;  ///< beside the destination
  std::filesystem::path staged_;            ///< alone in it
};

}  // namespace heightlight
