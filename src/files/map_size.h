#pragma once

#include <cstdint>
#include <filesystem>
#include <utility>

#include "heightlight/files.h"

namespace heightlight {

/// What reading a file may take, and what is to be done with its samples.
struct ReadLimit {
  ReadLimit(std::uint64_t bytes, WorkBytes bytes_of_work = {})
      : memory(bytes), work(std::move(bytes_of_work)) {}

  std::uint64_t memory;
  WorkBytes work;
};

/// Checks what a file's header announces before its samples are read. Throws Error naming the file for 0 × 0,
/// a side of more than 10^6 samples or more than 2^31 samples, MemoryError, which names it, too, where
/// reading
/// (`bytes_per_sample` for each) or the work that follows takes more memory than the limit.
void check_map_size(const std::filesystem::path& path, std::uint64_t columns, std::uint64_t rows,
                    std::uint64_t bytes_per_sample, const ReadLimit& limit);

}  // namespace heightlight
