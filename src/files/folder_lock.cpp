#include "files/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "files/input_file.h"
#include "files/output_file.h"

namespace heightlight {

FolderLock::FolderLock(const std::filesystem::path& folder) {
  descriptor_ = open((folder / ".heightlight-lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw output_error(folder, errno);
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  const int fault = errno;
  close(descriptor_);
  if (fault == EWOULDBLOCK) throw file_error(folder, "another process is at work in this folder");
  throw output_error(folder, fault);
}

FolderLock::~FolderLock() { close(descriptor_); }

}  // namespace heightlight
