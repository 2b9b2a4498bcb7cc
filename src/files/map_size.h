#pragma once

#include <cstdint>
#include <filesystem>
#include <utility>

#include "heightlight/files.h"

namespace heightlight {

/// The memory limit for reading a file, and the memory that the work on its samples will need.
struct ReadLimit {
  ReadLimit(std::uint64_t bytes, WorkBytes bytes_of_work = {})
      : memory(bytes), work(std::move(bytes_of_work)) {}

  std::uint64_t memory;
  WorkBytes work;
};

/// Checks the size in a file's header before the samples are read. Throws Error naming the file for 0 × 0,
/// for a side of more than 10^6 samples and for more than 2^31 samples. Throws MemoryError, which also names
/// the file, where reading (`bytes_per_sample` per sample) or the work that follows takes more memory than
/// the limit.
void check_map_size(const std::filesystem::path& path, std::uint64_t columns, std::uint64_t rows,
                    std::uint64_t bytes_per_sample, const ReadLimit& limit);

}  // namespace heightlight
