#include "visibility/horizon_scene.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/texels.h"
#include "visibility/surroundings.h"
#include "visibility/walk_tile.h"

namespace heightlight {
namespace {

/// Heights of level l as rings see them.
Map ring_heights(const HeightPyramid& pyramid, int l, float peak_share) {
  const HeightPyramid::Level& blocks = pyramid.levels[static_cast<std::size_t>(l) - 1];
  Map heights(blocks.mean.width, blocks.mean.height);
  for_texels(heights, [&](std::size_t i) {
    const float mean = blocks.mean.values[i];
    const float peak = blocks.highest.values[i] - mean;
    heights.values[i] = mean == kNoHeight ? kNoHeight : mean + peak_share * peak;
  });
  return heights;
}

/// The same for a level of a window, margin included.
Map ring_heights(const Surroundings::Level& blocks, float peak_share) {
  Map heights = blocks.mean;
  for_texels(heights, [&](std::size_t i) {
    float& height = heights.values[i];
    if (height != kNoHeight) height += peak_share * (blocks.highest.values[i] - height);
  });
  return heights;
}

/// Replaces missing samples by heights that occlude nothing.
Map sample_heights(Map heights) {
  for_texels(heights, [&](std::size_t i) {
    if (std::isnan(heights.values[i])) heights.values[i] = kNoHeight;
  });
  return heights;
}

/// Each height, raised by kLift of what the highest around it has above it. The result lacks the outermost
/// `beside` blocks of the level's margin, at least 1. Where there is nothing, nothing is lifted.
Map lifted_heights(const FieldPyramid::Level& level, int beside) {
  const int margin = level.margin - beside;
  Map lifted(level.width + 2 * margin, level.height + 2 * margin);
  const std::ptrdiff_t stride = level.stride();
  parallel_for(lifted.height, [&](std::int64_t row) {
    const float* here = level.origin() + (row - margin) * stride - margin;
    float* out = lifted.values.data() + row * lifted.width;
    for (std::ptrdiff_t column = 0; column < lifted.width; ++column) {
      float peak = here[column];
      for (const std::ptrdiff_t line : {-stride, std::ptrdiff_t{0}, stride}) {
        for (const std::ptrdiff_t aside : {-1, 0, 1}) peak = std::max(peak, here[column + line + aside]);
      }
      const float lift = WalkTile::kLift * (peak - here[column]);
      out[column] = here[column] == kNoHeight ? kNoHeight : here[column] + lift;
    }
  });
  return lifted;
}

/// Cuts the margin of a level of a window from `margin` down to `wanted` blocks.
Map with_margin(const Map& level, int margin, int wanted) {
  const int left_out = margin - wanted;
  assert(left_out >= 0);
  Map part(level.width - 2 * left_out, level.height - 2 * left_out);
  for (int row = 0; row < part.height; ++row)
    std::copy_n(&level(row + left_out, left_out), part.width, &part(row, 0));
  return part;
}

void fill_from_surroundings(const Surroundings& around, int rings, float peak_share, HorizonScene& scene) {
  const int margin = scene.heights.level(0).margin;
  assert(static_cast<std::size_t>(rings) < around.levels.size());
  for (int l = 0; l <= rings; ++l) {
    const Surroundings::Level& level = around.levels[static_cast<std::size_t>(l)];
    const Map heights = l == 0 ? sample_heights(level.mean) : ring_heights(level, peak_share);
    scene.heights.take_level(l, with_margin(heights, around.margin, margin));
  }
  // The outermost samples of the margin are not lifted: only the padding of vector loads reads them.
  const Map inner = lifted_heights(scene.heights.level(0), 1);
  Map lifted = with_margin(sample_heights(around.levels[0].mean), around.margin, margin);
  for (int row = 0; row < inner.height; ++row) std::copy_n(&inner(row, 0), inner.width, &lifted(row + 1, 1));
  scene.lifted.take_level(0, std::move(lifted));
}

}  // namespace

int walk_margin(const WalkOptions& options) { return near_margin(options) + kReadPadding; }

HorizonScene build_horizon_scene(const Surface& surface, const HeightPyramid& pyramid,
                                 const WalkOptions& options) {
  const int rings = ring_count(surface, options);
  const int margin = walk_margin(options);
  HorizonScene scene{{surface, rings, margin}, {surface, 0, margin}};
  if (surface.around) {
    fill_from_surroundings(*surface.around, rings, options.peak_share, scene);
    return scene;
  }
  scene.heights.fill_heights(0, pyramid.level_0(surface));
  for (int l = 1; l <= rings; ++l) {
    const int known = std::min(l, static_cast<int>(pyramid.levels.size()));
    if (known == 0) {
      scene.heights.fill_heights(l, pyramid.level_0(surface));
    } else {
      scene.heights.fill_heights(l, ring_heights(pyramid, known, options.peak_share));
    }
  }
  scene.lifted.fill_heights(0, lifted_heights(scene.heights.level(0), margin));
  return scene;
}

}  // namespace heightlight
