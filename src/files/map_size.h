#pragma once

#include <cstdint>
#include <filesystem>

namespace heightlight {

/// Checks what a file's header announces before its samples are read. Throws Error naming the file for 0 × 0,
/// a side of more than 10^6 samples, more than 2^31 samples, or more memory (`bytes_per_sample` for each)
/// than `memory_limit`.
void check_map_size(const std::filesystem::path& path, std::uint64_t columns, std::uint64_t rows,
                    std::uint64_t bytes_per_sample, std::uint64_t memory_limit);

}  // namespace heightlight
