#include "windows/whole_file.h"

#include <fmt/core.h>
#include <unistd.h>

#include <random>
#include <system_error>

#include "files/output_file.h"

namespace heightlight {
namespace {

/// Numbers of processes repeat between machines that share a folder, and a process that forks copies what it
/// drew. Together they do not. Nothing that is found depends on it.
std::string own_mark() {
  static const std::uint32_t drawn = std::random_device{}();
  return fmt::format("{:08x}-{}", drawn, getpid());
}

}  // namespace

std::filesystem::path unfinished(const std::filesystem::path& file) {
  return file.string() + "." + own_mark() + ".part";
}

void appear(const std::filesystem::path& file) {
  std::error_code failure;
  std::filesystem::rename(unfinished(file), file, failure);
  if (failure) throw output_error(file, failure.message());
}

}  // namespace heightlight
