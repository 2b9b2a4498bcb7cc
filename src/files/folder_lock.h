#pragma once

#include <filesystem>

namespace heightlight {

/// Keeps every other process that asks for it out of a folder, until this object or its process ends. Leaves
/// an empty file behind, `.heightlight-lock`.
class FolderLock {
 public:
  /// Throws Error naming the folder when another process has it, OutputError when it cannot be written to.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace heightlight
