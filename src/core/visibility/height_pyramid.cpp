#include "visibility/height_pyramid.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "surface/blocks.h"
#include "surface/occluders.h"

namespace heightlight {
namespace {

/// The children of a block: samples in level 1, blocks from level 2 on. Children weigh alike, except those
/// that are missing or hold no sample, which do not count.
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

HeightPyramid::Level coarsen_heights(const Image<float>& mean, const Image<float>& highest) {
  HeightPyramid::Level level{Image<float>(half_blocks(mean.width), half_blocks(mean.height)),
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

std::uint64_t height_pyramid_bytes(int width, int height) {
  std::uint64_t samples = 0;
  while (width > 1 || height > 1) {
    width = half_blocks(width);
    height = half_blocks(height);
    samples += static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  }
  return samples * 2 * sizeof(float);
}

HeightPyramid build_height_pyramid(const Surface& surface) {
  HeightPyramid pyramid;
  if (surface.around) return pyramid;
  if (has_loose_samples(surface)) pyramid.occluders = occluding_heights(surface);
  const Image<float>* mean = &pyramid.level_0(surface);
  const Image<float>* highest = mean;
  while (mean->width > 1 || mean->height > 1) {
    pyramid.levels.reserve(32);  // so that the pointers into it stay valid
    pyramid.levels.push_back(coarsen_heights(*mean, *highest));
    mean = &pyramid.levels.back().mean;
    highest = &pyramid.levels.back().highest;
  }
  return pyramid;
}

}  // namespace heightlight
