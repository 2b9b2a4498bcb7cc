#include "visibility/height_mips.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "surface/blocks.h"
#include "surface/occluders.h"

namespace heightlight {
namespace {

/// Number of samples present in each block of level 1; from level 2 on, blocks weigh alike, except those that
/// hold none.
struct Children {
  float sum = 0;
  float highest = kNoHeight;
  int present = 0;

  void add(float mean, float top) {
    if (std::isnan(mean) || mean == kNoHeight) return;
    sum += mean;
    highest = std::max(highest, top);
    ++present;
  }
};

}  // namespace

HeightMips::Level coarsen_heights(const Image<float>& mean, const Image<float>& highest) {
  HeightMips::Level level{Image<float>(half_blocks(mean.width), half_blocks(mean.height)),
                          Image<float>(half_blocks(mean.width), half_blocks(mean.height))};
  parallel_for(level.mean.height, [&](std::int64_t line) {
    const int row = static_cast<int>(line);
    for (int column = 0; column < level.mean.width; ++column) {
      Children children;
      for (int i = 2 * row; i < std::min(2 * row + 2, mean.height); ++i) {
        for (int j = 2 * column; j < std::min(2 * column + 2, mean.width); ++j) {
          children.add(mean(i, j), highest(i, j));
        }
      }
      const bool any = children.present > 0;
      level.mean(row, column) = any ? children.sum / static_cast<float>(children.present) : kNoHeight;
      level.highest(row, column) = children.highest;
    }
  });
  return level;
}

std::uint64_t height_mips_bytes(int width, int height) {
  std::uint64_t samples = 0;
  while (width > 1 || height > 1) {
    width = half_blocks(width);
    height = half_blocks(height);
    samples += static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  }
  return samples * 2 * sizeof(float);
}

HeightMips build_height_mips(const Surface& surface) {
  HeightMips mips;
  if (surface.around) return mips;
  if (has_loose_samples(surface)) mips.occluders = occluding_heights(surface);
  const Image<float>* mean = &mips.level_0(surface);
  const Image<float>* highest = mean;
  while (mean->width > 1 || mean->height > 1) {
    mips.levels.reserve(32);  // so that the pointers into it stay
    mips.levels.push_back(coarsen_heights(*mean, *highest));
    mean = &mips.levels.back().mean;
    highest = &mips.levels.back().highest;
  }
  return mips;
}

}  // namespace heightlight
