#include "files/map_size.h"

#include <algorithm>
#include <string>

#include "base/byte_size.h"
#include "files/input_file.h"

namespace heightlight {
namespace {

constexpr std::uint64_t kLongestSide = 1'000'000;
constexpr std::uint64_t kMostSamples = std::uint64_t{1} << 31;

}  // namespace

void check_map_size(const std::filesystem::path& path, std::uint64_t columns, std::uint64_t rows,
                    std::uint64_t bytes_per_sample, const ReadLimit& limit) {
  const std::string size = std::to_string(columns) + " x " + std::to_string(rows) + " samples";
  if (columns == 0 || rows == 0) throw file_error(path, size + ": there is nothing in it");
  if (columns > kLongestSide || rows > kLongestSide || columns * rows > kMostSamples) {
    throw file_error(path, size + " are too many: at most 2^31, and 1000000 on a side");
  }
  const std::uint64_t reading = columns * rows * bytes_per_sample;
  const std::uint64_t work = limit.work ? limit.work(static_cast<int>(columns), static_cast<int>(rows)) : 0;
  const std::uint64_t needed = std::max(reading, work);
  if (needed <= limit.memory) return;
  throw MemoryError(path.string() + ": " + (work > reading ? "work on " : "reading ") + size + " takes " +
                        format_byte_size(needed) + " of memory, and " + format_byte_size(limit.memory) +
                        " are allowed",
                    needed - limit.memory, write_enough(needed));
}

}  // namespace heightlight
