#pragma once

#include <filesystem>
#include <memory>

#include "files/lock_file.h"

namespace heightlight {

/// The place of a work folder, which this process has for itself. Unless keep() was called, the destructor
/// removes the work, and the folder around it where this object made that and nothing else is in it.
class WorkPlace {
 public:
  /// Makes the folder around it. Throws Error when another process is at work there, OutputError when it
  /// cannot be made.
  explicit WorkPlace(std::filesystem::path work);
  ~WorkPlace();
  WorkPlace(const WorkPlace&) = delete;
  WorkPlace& operator=(const WorkPlace&) = delete;

  /// What was found stays, for the next process.
  void keep() { keeps_ = true; }

 private:
  std::filesystem::path work_;
  bool made_around_ = false;
  bool keeps_ = false;
  std::unique_ptr<LockFile> lock_;
};

}  // namespace heightlight
