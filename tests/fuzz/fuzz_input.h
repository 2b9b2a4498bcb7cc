#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "heightlight/error.h"

namespace heightlight {

/// A file in memory that holds one input after the other, for readers that want a path.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("fuzz", MFD_CLOEXEC)) {
    path_ = "/proc/self/fd/" + std::to_string(descriptor_);
  }
  const std::filesystem::path& hold(const std::uint8_t* data, std::size_t size) {
    const bool held =
        ftruncate(descriptor_, 0) == 0 && pwrite(descriptor_, data, size, 0) == static_cast<ssize_t>(size);
    if (!held) std::abort();
    return path_;
  }

 private:
  int descriptor_;
  std::filesystem::path path_;
};

/// What must hold, or the fuzzer has found something.
inline void require(bool holds, const char* claim) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", claim);
  std::abort();
}

/// Lets `read` have the input; the only thing that it may throw is an Error of one line that names the file.
template <class Read>
void expect_line_or_result(const std::filesystem::path& path, Read&& read) {
  try {
    read();
  } catch (const Error& error) {
    const std::string line = error.what();
    require(line.find('\n') == std::string::npos, "an error is one line");
    require(line.find(path.string()) != std::string::npos, "an error names the file");
  }
}

/// Memory that a reader may take, far below the fuzzer's limit.
constexpr std::uint64_t kReaderMemory = 64 << 20;

}  // namespace heightlight
