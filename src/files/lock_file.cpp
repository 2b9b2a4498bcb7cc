#include "files/lock_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "files/interrupt.h"
#include "files/output_file.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;

/// Whether the open file still has this name; its former holder may have removed the name meanwhile.
bool is_named(int descriptor, const fs::path& path) {
  struct stat opened {};
  struct stat named {};
  return fstat(descriptor, &opened) == 0 && lstat(path.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

/// The locks of this process. Never destroyed, because the end of the process needs them.
struct HeldLocks {
  std::mutex mutex;
  std::set<const fs::path*> files;
};

HeldLocks& held_locks() {
  static HeldLocks* const kHeld = new HeldLocks;
  return *kHeld;
}

}  // namespace

std::unique_ptr<LockFile> LockFile::try_take(const fs::path& path) {
  for (;;) {
    // Opened for writing, because NFS grants exclusive locks only then.
    const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor < 0) throw output_error(path, errno);
    const bool is_held = flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (!is_held && is_named(descriptor, path))
      return std::unique_ptr<LockFile>(new LockFile(path, descriptor));
    close(descriptor);
    if (is_held) return nullptr;
  }
}

std::unique_ptr<LockFile> LockFile::take(const fs::path& path) {
  for (;;) {
    if (auto lock = try_take(path)) return lock;
    wait_for_locks();
  }
}

LockFile::LockFile(fs::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {
  const std::lock_guard guard(held_locks().mutex);
  held_locks().files.insert(&path_);
}

LockFile::~LockFile() {
  const std::lock_guard guard(held_locks().mutex);
  held_locks().files.erase(&path_);
  // while the lock is held, so that nobody else can have taken the lock under this name
  unlink(path_.c_str());
  close(descriptor_);
}

void leave_locks() {
  held_locks().mutex.lock();  // never unlocked: a file with this name may soon be another process's
  for (const fs::path* file : held_locks().files) unlink(file->c_str());
}

void wait_for_locks() {
  throw_if_interrupted();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
}

}  // namespace heightlight
