#include "surface/blocks.h"

#include <cstdint>

namespace heightlight {
namespace {

/// Where a coordinate lies in the map: wrapped under `tile`; −1 where nothing is.
int to_map(std::int64_t i, int count, bool tiles) {
  if (i >= 0 && i < count) return static_cast<int>(i);
  if (!tiles) return -1;
  const std::int64_t wrapped = i % count;
  return static_cast<int>(wrapped < 0 ? wrapped + count : wrapped);
}

}  // namespace

std::vector<int> block_sources(int first, int count, int level, int samples, bool tiles) {
  std::vector<int> sources(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const std::int64_t start = (std::int64_t{first} + i) << level;
    const std::int64_t middle = start + (level > 0 ? std::int64_t{1} << (level - 1) : 0);
    const bool inside = start >= 0 && start < samples;
    const int sample = inside ? static_cast<int>(start) : to_map(middle, samples, tiles);
    sources[static_cast<std::size_t>(i)] = sample < 0 ? -1 : sample >> level;
  }
  return sources;
}

}  // namespace heightlight
