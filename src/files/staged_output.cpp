#include "files/staged_output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <system_error>

#include "files/input_file.h"
#include "files/output_file.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;

void sync_to_disk(const fs::path& staged, const fs::path& destination) {
  const int descriptor = open(staged.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw output_error(destination, "nothing was put there");
  const int result = fsync(descriptor);
  const int error_number = errno;
  close(descriptor);
  // Some file systems have nothing to sync to and return EINVAL.
  if (result != 0 && error_number != EINVAL) throw output_error(destination, error_number);
}

/// Syncs a folder, so that the names in it survive a power failure; failures are ignored.
void sync_names(const fs::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

/// A rename would replace a device and fail on a folder. Both are rejected here, before any work is done.
void check_replaceable(const fs::path& destination) {
  std::error_code ignored;
  const fs::file_status status = fs::status(destination, ignored);
  if (fs::is_directory(status)) throw output_error(destination, "it is a directory");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw output_error(destination, "it is not a regular file");
  }
}

void rename_into_place(const fs::path& staged, const fs::path& destination) {
  std::error_code failure;
  fs::rename(staged, destination, failure);
  if (failure) throw output_error(destination, failure.message());
}

/// The topmost folder on the way to `folder` that does not exist; empty if all exist.
fs::path topmost_missing(fs::path folder) {
  fs::path missing;
  std::error_code ignored;
  for (; !folder.empty() && !fs::exists(folder, ignored); folder = folder.parent_path()) missing = folder;
  return missing;
}

/// Removes `folder` and its parents up to `top`. A folder that is not empty stays, and so do its parents.
void remove_empty_folders(fs::path folder, const fs::path& top) {
  std::error_code ignored;
  for (; !top.empty(); folder = folder.parent_path()) {
    fs::remove(folder, ignored);
    if (folder == top) return;
  }
}

/// Rejects a name that is too long for its file system now; otherwise it would fail only after all work is
/// done.
void check_name_length(const fs::path& existing_folder, const fs::path& destination) {
  const long most = pathconf(existing_folder.c_str(), _PC_NAME_MAX);
  if (most > 0 && destination.filename().string().size() > static_cast<std::size_t>(most))
    throw output_error(destination, ENAMETOOLONG);
}

fs::path parent_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// Device and inode of a file; empty if there is no file.
std::optional<std::pair<std::uint64_t, std::uint64_t>> identity_of(const fs::path& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return std::nullopt;
  return std::pair(std::uint64_t{status.st_dev}, std::uint64_t{status.st_ino});
}

}  // namespace

InputGuard::InputGuard(const std::vector<fs::path>& inputs) {
  std::map<Identity, fs::path> known;
  for (const fs::path& input : inputs) {
    if (const auto identity = identity_of(input)) known.emplace(*identity, input);
  }
  inputs_ = std::make_shared<const std::map<Identity, fs::path>>(std::move(known));
}

const fs::path* InputGuard::find(const fs::path& destination) const {
  const auto identity = identity_of(destination);
  const auto found = identity ? inputs_->find(*identity) : inputs_->end();
  return found == inputs_->end() ? nullptr : &found->second;
}

void InputGuard::check(const fs::path& destination) const {
  const fs::path* input = find(destination);
  if (!input) return;
  UsageError error(input->string() + ": the results would replace it; choose another place for them");
  error.remedy = "output";
  throw error;
}

StagedFolder::StagedFolder(fs::path folder, InputGuard inputs, const std::vector<std::string>& results,
                           FormerRecord record)
    : folder_(std::move(folder)), inputs_(std::move(inputs)), record_(std::move(record)) {
  if (!folder_.has_filename()) folder_ = folder_.parent_path();  // treats "out/" as "out"
  for (const std::string& name : results) inputs_.check(folder_ / name);
  std::error_code failure;
  const fs::file_status status = fs::status(folder_, failure);
  if (status.type() == fs::file_type::none) throw output_error(folder_, failure.message());
  if (fs::exists(status) && !fs::is_directory(status))
    throw file_error(folder_, "exists and is not a folder");
  is_new_ = !fs::exists(status);
  if (is_new_ && fs::is_symlink(fs::symlink_status(folder_, failure)))
    throw output_error(folder_, "it is a link to nothing");
  const fs::path parent = parent_of(folder_);
  if (is_new_) {
    first_created_ = topmost_missing(parent);
    fs::create_directories(parent, failure);
  }
  try {
    if (is_new_ && failure) throw output_error(folder_, failure.message());
    // A name that is too long is detected only now that its parent exists.
    if (fs::status(folder_, failure).type() == fs::file_type::none)
      throw output_error(folder_, failure.message());
    for (const std::string& name : results) check_name_length(is_new_ ? parent : folder_, folder_ / name);
    staging_ = std::make_unique<StagingFolder>(is_new_ ? parent : folder_, folder_, folder_);
  } catch (const Error&) {
    remove_empty_folders(parent, first_created_);
    throw;
  }
  if (record_.file.empty() || is_new_) return;
  former_ = read_file_records(folder_ / record_.file).value_or(former_);
  std::erase_if(former_, [&](const FileRecord& file) {
    const bool prefixed = !record_.prefix.empty() && file.name.starts_with(record_.prefix);
    return !prefixed && std::find(results.begin(), results.end(), file.name) == results.end();
  });
}

StagedFolder::~StagedFolder() {
  staging_.reset();
  if (!committed_) remove_empty_folders(parent_of(folder_), first_created_);
}

fs::path StagedFolder::file(const std::string& name) {
  if (std::find(names_.begin(), names_.end(), name) == names_.end()) {
    inputs_.check(final_path(name));
    check_replaceable(final_path(name));
    names_.push_back(name);
  }
  return staging_->path() / name;
}

void StagedFolder::leave_out(const std::string& name) {
  std::erase(names_, name);
  std::error_code ignored;
  fs::remove(staging_->path() / name, ignored);
}

void StagedFolder::put_in_place() {
  if (is_new_ && staging_->become(folder_)) return;
  // The folder existed before, or another process has made it meanwhile: files are renamed one by one.
  for (const std::string& name : names_) rename_into_place(staging_->path() / name, final_path(name));
}

std::vector<FileRecord> StagedFolder::written() const {
  std::vector<FileRecord> records;
  for (const std::string& name : names_) records.push_back(record_file(staging_->path() / name, name));
  return records;
}

/// Removes only files that are as recorded; a different file with that name is not ours.
std::vector<std::string> StagedFolder::remove_former() {
  std::vector<std::string> removed;
  for (const FileRecord& file : former_) {
    const fs::path path = final_path(file.name);
    const bool stays =
        file.name == record_.file || std::find(names_.begin(), names_.end(), file.name) != names_.end();
    std::error_code failure;
    if (stays || !fs::is_regular_file(fs::symlink_status(path, failure)) || inputs_.find(path)) continue;
    if (is_as_recorded(folder_, file) && fs::remove(path, failure)) removed.push_back(file.name);
  }
  return removed;
}

std::vector<std::string> StagedFolder::commit() {
  // Everything that can fail for lack of space or because of a folder in the way fails here, before the first
  // file is replaced.
  for (const std::string& name : names_) {
    sync_to_disk(staging_->path() / name, final_path(name));
    check_replaceable(final_path(name));
  }
  sync_names(staging_->path());
  std::vector<std::string> removed;
  {
    const auto lock = hold_off_end();
    put_in_place();
    committed_ = true;
    removed = remove_former();
  }
  staging_.reset();
  sync_names(folder_);
  sync_names(parent_of(folder_));
  return removed;
}

StagedFile::StagedFile(fs::path destination, const std::vector<fs::path>& inputs)
    : destination_(std::move(destination)) {
  if (!destination_.has_filename()) throw file_error(destination_, "is not the name of a file");
  InputGuard(inputs).check(destination_);
  check_replaceable(destination_);
  const fs::path folder = parent_of(destination_);
  std::error_code ignored;
  if (!fs::exists(folder, ignored)) throw output_error(destination_, "its folder does not exist");
  check_name_length(folder, destination_);
  staging_ = std::make_unique<StagingFolder>(folder, folder, destination_);
  staged_ = staging_->path() / destination_.filename();
}

void StagedFile::commit() {
  sync_to_disk(staged_, destination_);
  {
    const auto lock = hold_off_end();
    rename_into_place(staged_, destination_);
  }
  sync_names(parent_of(destination_));
}

}  // namespace heightlight
