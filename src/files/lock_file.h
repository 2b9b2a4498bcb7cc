#pragma once

#include <filesystem>
#include <memory>

namespace heightlight {

/// A lock on work that only one process at a time may do. It is held until this object or its process ends,
/// and is represented by an empty file that exists meanwhile. A file left by a killed process locks nothing.
/// Processes on several machines exclude each other if their common file system forwards locks (NFS does, as
/// byte-range locks).
class LockFile {
 public:
  /// Returns null where another process holds the lock. If the file system does not support locks, every
  /// caller gets it: work may then be done twice, which is harmless for results that appear whole or not at
  /// all. Throws OutputError naming the path when no file can be made there.
  static std::unique_ptr<LockFile> try_take(const std::filesystem::path& path);

  /// Waits until no other process holds the lock. Throws as try_take does, and Cancelled.
  static std::unique_ptr<LockFile> take(const std::filesystem::path& path);

  ~LockFile();
  LockFile(const LockFile&) = delete;
  LockFile& operator=(const LockFile&) = delete;

 private:
  LockFile(std::filesystem::path path, int descriptor);

  std::filesystem::path path_;
  int descriptor_;
};

/// Removes the lock files of this process, which must end at once; the locks stay held until then.
void leave_locks();

/// Sleeps for a fifth of a second, between two attempts to take locks that others hold. Throws Cancelled.
void wait_for_locks();

}  // namespace heightlight
