#include "files/staged_output.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
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
  // Some file systems have nothing to sync to and say EINVAL.
  if (result != 0 && error_number != EINVAL) throw output_error(destination, error_number);
}

/// So that the names in a folder survive a power cut; as far as the system lets us.
void sync_names(const fs::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

/// A rename would replace a device or fail on a folder; both are refused before work is spent.
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

/// The topmost folder on the way to `folder` that does not exist; empty when all do.
fs::path topmost_missing(fs::path folder) {
  fs::path missing;
  std::error_code ignored;
  for (; !folder.empty() && !fs::exists(folder, ignored); folder = folder.parent_path()) missing = folder;
  return missing;
}

/// Removes `folder` and its parents up to `top`; a folder that is not empty stays, and so do those above it.
void remove_empty_folders(fs::path folder, const fs::path& top) {
  std::error_code ignored;
  for (; !top.empty(); folder = folder.parent_path()) {
    fs::remove(folder, ignored);
    if (folder == top) return;
  }
}

fs::path parent_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

}  // namespace

void check_inputs_stay(const std::vector<fs::path>& inputs, const fs::path& destination) {
  for (const fs::path& input : inputs) {
    std::error_code ignored;  // of files that do not exist, which nothing replaces
    if (!fs::equivalent(input, destination, ignored)) continue;
    UsageError error(input.string() + ": the results would replace it; choose another place for them");
    error.remedy = "output";
    throw error;
  }
}

StagedFolder::StagedFolder(fs::path folder, std::vector<fs::path> inputs,
                           const std::vector<std::string>& results)
    : folder_(std::move(folder)), inputs_(std::move(inputs)) {
  if (!folder_.has_filename()) folder_ = folder_.parent_path();  // "out/" is "out"
  for (const std::string& name : results) check_inputs_stay(inputs_, folder_ / name);
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
    // A name that is too long shows only now, where its parent is.
    if (fs::status(folder_, failure).type() == fs::file_type::none)
      throw output_error(folder_, failure.message());
    staging_ = std::make_unique<StagingFolder>(is_new_ ? parent : folder_, folder_, folder_);
  } catch (const Error&) {
    remove_empty_folders(parent, first_created_);
    throw;
  }
}

StagedFolder::~StagedFolder() {
  staging_.reset();
  if (!committed_) remove_empty_folders(parent_of(folder_), first_created_);
}

fs::path StagedFolder::file(const std::string& name) {
  if (std::find(names_.begin(), names_.end(), name) == names_.end()) {
    check_inputs_stay(inputs_, final_path(name));
    check_replaceable(final_path(name));
    names_.push_back(name);
  }
  return staging_->path() / name;
}

void StagedFolder::put_in_place() {
  const auto lock = hold_off_end();
  if (is_new_ && staging_->become(folder_)) return;
  // Files of the folder that was there, or that another process has made meanwhile.
  for (const std::string& name : names_) rename_into_place(staging_->path() / name, final_path(name));
}

void StagedFolder::commit() {
  // All that can fail for want of space or by a folder in the way fails here, before the first file is
  // replaced.
  for (const std::string& name : names_) {
    sync_to_disk(staging_->path() / name, final_path(name));
    check_replaceable(final_path(name));
  }
  sync_names(staging_->path());
  put_in_place();
  committed_ = true;
  staging_.reset();
  sync_names(folder_);
  sync_names(parent_of(folder_));
}

StagedFile::StagedFile(fs::path destination, const std::vector<fs::path>& inputs)
    : destination_(std::move(destination)) {
  if (!destination_.has_filename()) throw file_error(destination_, "is not the name of a file");
  check_inputs_stay(inputs, destination_);
  check_replaceable(destination_);
  const fs::path folder = parent_of(destination_);
  std::error_code ignored;
  if (!fs::exists(folder, ignored)) throw output_error(destination_, "its folder does not exist");
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
