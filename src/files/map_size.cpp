#include "files/map_size.h"

#include <string>

#include "base/byte_size.h"
#include "files/input_file.h"

namespace heightlight {
namespace {

constexpr std::uint64_t kLongestSide = 1'000'000;
constexpr std::uint64_t kMostSamples = std::uint64_t{1} << 31;

/// "3G" or "40M": an amount of memory that is enough.
std::string enough_memory(std::uint64_t bytes) {
  constexpr std::uint64_t kMebi = 1 << 20;
  constexpr std::uint64_t kGibi = 1 << 30;
  if (bytes > kGibi) return std::to_string((bytes + kGibi - 1) / kGibi) + "G";
  return std::to_string((bytes + kMebi - 1) / kMebi) + "M";
}

}  // namespace

void check_map_size(const std::filesystem::path& path, std::uint64_t columns, std::uint64_t rows,
                    std::uint64_t bytes_per_sample, std::uint64_t memory_limit) {
  const std::string size = std::to_string(columns) + " x " + std::to_string(rows) + " samples";
  if (columns == 0 || rows == 0) throw file_error(path, size + ": there is nothing in it");
  if (columns > kLongestSide || rows > kLongestSide || columns * rows > kMostSamples) {
    throw file_error(path, size + " are too many: at most 2^31, and 1000000 on a side");
  }
  const std::uint64_t needed = columns * rows * bytes_per_sample;
  if (needed > memory_limit) {
    throw file_error(path,
                     "reading " + size + " takes " + format_byte_size(needed) + " of memory, and " +
                         format_byte_size(memory_limit) + " are allowed; allow more, or make the map smaller",
                     "memory " + enough_memory(needed));
  }
}

}  // namespace heightlight
