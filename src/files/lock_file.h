#pragma once

#include <filesystem>
#include <memory>

namespace heightlight {

/// A piece of work that one process at a time does, until this object or its process ends: a file, empty,
/// that is there meanwhile. What a killed process left locks nothing. Processes on several machines exclude
/// each other where their common file system passes locks on (NFS does, as byte-range locks).
class LockFile {
 public:
  /// Nothing where another holds it. Where the file system knows no locks, whoever asks gets it: work then
  /// may be done twice, which results that appear whole or not at all survive. Throws OutputError naming the
  /// path when no file can be made there.
  static std::unique_ptr<LockFile> try_take(const std::filesystem::path& path);

  /// Waits until nobody else holds it. Throws Cancelled, too.
  static std::unique_ptr<LockFile> take(const std::filesystem::path& path);

  ~LockFile();
  LockFile(const LockFile&) = delete;
  LockFile& operator=(const LockFile&) = delete;

 private:
  LockFile(std::filesystem::path path, int descriptor);

  std::filesystem::path path_;
  int descriptor_;
};

/// Removes the files of the locks that this process holds, which must end at once, and stay held until then.
void leave_locks();

/// Between two looks at locks that others hold: sleeps for a fifth of a second. Throws Cancelled.
void wait_for_locks();

}  // namespace heightlight
