#include "windows/work_place.h"

#include <system_error>

#include "files/input_file.h"
#include "files/output_file.h"

namespace heightlight {

namespace fs = std::filesystem;

WorkPlace::WorkPlace(fs::path work) : work_(std::move(work)) {
  std::error_code failure;
  made_around_ = fs::create_directories(work_.parent_path(), failure);
  if (failure) throw output_error(work_.parent_path(), failure.message());
  lock_ = LockFile::try_take(work_.string() + ".lock");
  if (lock_) return;
  throw file_error(work_.parent_path(), "another process bakes the same map into it");
}

WorkPlace::~WorkPlace() {
  std::error_code ignored;
  if (!keeps_) fs::remove_all(work_, ignored);
  lock_.reset();
  if (!keeps_ && made_around_) fs::remove(work_.parent_path(), ignored);  // only where it is empty
}

}  // namespace heightlight
