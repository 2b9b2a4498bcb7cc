#include "visibility/horizon_scene.h"

#include <algorithm>
#include <cmath>

#include "base/texels.h"
#include "visibility/walk_tile.h"

namespace heightlight {
namespace {

/// What rings see of level l.
Map ring_heights(const HeightMips& mips, int l, float peak_share) {
  const HeightMips::Level& blocks = mips.levels[static_cast<std::size_t>(l) - 1];
  Map heights(blocks.mean.width, blocks.mean.height);
  for_texels(heights, [&](std::size_t i) {
    const float mean = blocks.mean.values[i];
    const float peak = blocks.highest.values[i] - mean;
    heights.values[i] = mean == kNoHeight ? kNoHeight : mean + peak_share * peak;
  });
  return heights;
}

/// Each height and kLift of what the highest around it has above it; `level` has margins, the outermost rows
/// and columns of which stay as they are.
Map lifted_heights(const FieldPyramid::Level& level) {
  Map lifted(level.width, level.height);
  const std::ptrdiff_t stride = level.stride();
  parallel_for(level.height, [&](std::int64_t row) {
    const float* here = level.origin() + row * stride;
    float* out = lifted.values.data() + row * level.width;
    for (std::ptrdiff_t column = 0; column < level.width; ++column) {
      float peak = here[column];
      for (const std::ptrdiff_t line : {-stride, std::ptrdiff_t{0}, stride}) {
        for (const std::ptrdiff_t beside : {-1, 0, 1}) peak = std::max(peak, here[column + line + beside]);
      }
      out[column] = here[column] + WalkTile::kLift * (peak - here[column]);
    }
  });
  return lifted;
}

}  // namespace

int walk_reach(const WalkOptions& options) { return near_reach(options) + kReadPadding; }

HorizonScene build_horizon_scene(const Surface& surface, const HeightMips& mips, const WalkOptions& options) {
  const int rings = ring_count(surface, options);
  const int reach = walk_reach(options);
  HorizonScene scene{{surface, rings, reach}, {surface, 0, reach}};
  scene.heights.fill_heights(0, mips.level_0(surface));
  for (int l = 1; l <= rings; ++l) {
    const int known = std::min(l, static_cast<int>(mips.levels.size()));
    if (known == 0) {
      scene.heights.fill_heights(l, mips.level_0(surface));
    } else {
      scene.heights.fill_heights(l, ring_heights(mips, known, options.peak_share));
    }
  }
  scene.lifted.fill_heights(0, lifted_heights(scene.heights.level(0)));
  return scene;
}

}  // namespace heightlight
