#pragma once

#include <hwy/highway.h>
#include <hwy/targets.h>

#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "test_maps.h"
#include "visibility/sky_walk.h"

namespace heightlight {

/// The sums of a sky walk over a whole map, per texel in row-major order.
struct WalkedSky {
  std::vector<float> sky, full, solid;
  std::vector<FarView> views;  ///< per tile and azimuth
};

using LookFar = void (*)(const WalkTile&, const AzimuthTable&, FarView&);
using WalkSky = void (*)(const WalkTile&, const AzimuthTable&, const FarView&, SkySums&);

/// Calls visit(tile) for each tile of the map, loaded for walks with these options.
template <class Visit>
void for_tiles(const Surface& surface, const WalkOptions& options, Visit&& visit) {
  const HeightPyramid pyramid = build_height_pyramid(surface);
  const int rings = ring_count(surface, options);
  const TileGrid grid(surface.width(), surface.height());
  const auto tile = std::make_unique<WalkTile>();
  for (std::int64_t i = 0; i < grid.count(); ++i) {
    tile->load(surface, pyramid, options, rings, grid.frame(i));
    visit(*tile);
  }
}

/// Walks tile after tile with a kernel of one's choice.
inline WalkedSky walk_sky_with(LookFar look, WalkSky walk, const Surface& surface,
                               const WalkOptions& options) {
  WalkedSky result;
  for (std::vector<float>* sums : {&result.sky, &result.full, &result.solid}) {
    sums->resize(surface.map.height.size());
  }
  for_tiles(surface, options, [&](const WalkTile& tile) {
    const auto sums = std::make_unique<SkySums>();
    for (int k = 0; k < options.azimuths; ++k) {
      const AzimuthTable azimuth = make_azimuth_table(surface, options, azimuth_rad(options, k));
      look(tile, azimuth, result.views.emplace_back());
      walk(tile, azimuth, result.views.back(), *sums);
    }
    for (int i = 0; i < tile.rows; ++i) {
      for (int j = 0; j < tile.columns; ++j) {
        const auto at = static_cast<std::size_t>(i * WalkTile::kSide + j);
        const std::size_t texel = surface.map.height.index(tile.first_row + i, tile.first_column + j);
        result.sky[texel] = sums->sky[at];
        result.full[texel] = sums->full[at];
        result.solid[texel] = sums->solid[at];
      }
    }
  });
  return result;
}

/// While it lives, kernels run as they do on machines that have this instruction set and no better one.
class InstructionSet {
 public:
  explicit InstructionSet(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
  }
  ~InstructionSet() {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  InstructionSet(const InstructionSet&) = delete;
  InstructionSet& operator=(const InstructionSet&) = delete;
};

/// What this machine offers of those that kernels are compiled for.
inline std::vector<std::int64_t> instruction_sets() { return hwy::SupportedAndGeneratedTargets(); }

/// Smooth and of no simple size: waves that fit the map however many samples it has.
inline Heightmap make_smooth_map(int width, int height, Boundary boundary, double relief) {
  return make_map(width, height, boundary, [&](int row, int column) {
    const double x = 2 * std::numbers::pi * column / width;
    const double y = 2 * std::numbers::pi * row / height;
    return relief * (0.5 + 0.25 * std::sin(2 * x + y) + 0.25 * std::cos(3 * y - 5 * x));
  });
}

}  // namespace heightlight
