#include "io/staged_output.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "io/input_file.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;

std::string system_message(int error_number) { return std::generic_category().message(error_number); }

/// A new hidden folder in `folder`, so that renaming from one to the other never crosses file systems.
fs::path make_staging(const fs::path& folder) {
  std::string name = (folder / ".heightlight-XXXXXX").string();
  if (!mkdtemp(name.data())) throw file_error(folder, "cannot be written to: " + system_message(errno));
  return name;
}

void sync_to_disk(const fs::path& staged, const fs::path& destination) {
  const int descriptor = open(staged.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw file_error(destination, "was not written");
  const int result = fsync(descriptor);
  const int error_number = errno;
  close(descriptor);
  // Some file systems have nothing to sync to and say EINVAL.
  if (result != 0 && error_number != EINVAL) {
    throw file_error(destination, "cannot be written: " + system_message(error_number));
  }
}

/// A rename would replace a device or fail on a folder; both are refused before work is spent.
void check_replaceable(const fs::path& destination) {
  std::error_code ignored;
  const fs::file_status status = fs::status(destination, ignored);
  if (fs::is_directory(status)) throw file_error(destination, "cannot be written: it is a directory");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw file_error(destination, "cannot be written: it is not a regular file");
  }
}

void put_in_place(const fs::path& staged, const fs::path& destination) {
  std::error_code failure;
  fs::rename(staged, destination, failure);
  if (failure) throw file_error(destination, "cannot be written: " + failure.message());
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

}  // namespace

StagedFolder::StagedFolder(fs::path folder) : folder_(std::move(folder)) {
  if (!folder_.has_filename()) folder_ = folder_.parent_path();  // "out/" is "out"
  std::error_code failure;
  if (fs::exists(folder_, failure) && !fs::is_directory(folder_, failure)) {
    throw file_error(folder_, "exists and is not a folder");
  }
  first_created_ = topmost_missing(folder_);
  fs::create_directories(folder_, failure);
  try {
    if (failure) throw file_error(folder_, "cannot be created: " + failure.message());
    staging_ = make_staging(folder_);
  } catch (const Error&) {
    remove_empty_folders(folder_, first_created_);
    throw;
  }
}

StagedFolder::~StagedFolder() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
  remove_empty_folders(folder_, first_created_);
}

fs::path StagedFolder::file(const std::string& name) {
  if (std::find(names_.begin(), names_.end(), name) == names_.end()) {
    check_replaceable(final_path(name));
    names_.push_back(name);
  }
  return staging_ / name;
}

void StagedFolder::commit() {
  // All that can fail for want of space or by a folder in the way fails here, before the first file is
  // replaced.
  for (const std::string& name : names_) {
    sync_to_disk(staging_ / name, final_path(name));
    check_replaceable(final_path(name));
  }
  for (const std::string& name : names_) put_in_place(staging_ / name, final_path(name));
  committed_ = true;
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
  sync_to_disk(folder_, folder_);
}

StagedFile::StagedFile(fs::path destination) : destination_(std::move(destination)) {
  if (!destination_.has_filename()) throw file_error(destination_, "is not the name of a file");
  check_replaceable(destination_);
  const fs::path folder = destination_.has_parent_path() ? destination_.parent_path() : fs::path(".");
  std::error_code ignored;
  if (!fs::exists(folder, ignored))
    throw file_error(destination_, "cannot be written: its folder does not exist");
  staged_ = make_staging(folder) / destination_.filename();
}

StagedFile::~StagedFile() {
  std::error_code ignored;
  fs::remove_all(staged_.parent_path(), ignored);
}

void StagedFile::commit() {
  sync_to_disk(staged_, destination_);
  put_in_place(staged_, destination_);
  const fs::path folder = staged_.parent_path().parent_path();
  sync_to_disk(folder, folder);
}

}  // namespace heightlight
