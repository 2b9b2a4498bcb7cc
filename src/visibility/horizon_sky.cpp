#include "visibility/horizon_sky.h"

#include <algorithm>
#include <limits>
#include <memory>

#include "core/parallel.h"
#include "visibility/sky_walk.h"

namespace heightlight {
namespace {

/// What a thread needs to walk tile after tile.
struct Workspace {
  WalkTile tile;
  SkySums sums;
  FarView far;
};

void write_tile(const Workspace& work, int azimuths, HorizonSky& sky) {
  for (int i = 0; i < work.tile.rows; ++i) {
    for (int j = 0; j < work.tile.columns; ++j) {
      const auto at = static_cast<std::size_t>(i * WalkTile::kSide + j);
      const bool present = work.tile.present[at];
      constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
      sky.sky_view_factor(work.tile.first_row + i, work.tile.first_column + j) =
          present ? std::clamp(work.sums.sky[at] / work.sums.full[at], 0.0F, 1.0F) : kMissing;
      sky.ambient_occlusion(work.tile.first_row + i, work.tile.first_column + j) =
          present ? std::clamp(work.sums.solid[at] / static_cast<float>(azimuths), 0.0F, 1.0F) : kMissing;
    }
  }
}

}  // namespace

HorizonSky walk_horizon_sky(const Surface& surface, const HeightMips& mips, const WalkOptions& options,
                            bool quiet) {
  std::vector<AzimuthTable> azimuths;
  for (int k = 0; k < options.azimuths; ++k) azimuths.push_back(make_azimuth_table(surface, options, k));
  const int rings = ring_count(surface, options);
  HorizonSky sky{Map(surface.width(), surface.height()), Map(surface.width(), surface.height())};
  const TileGrid tiles(surface.width(), surface.height());
  std::vector<std::unique_ptr<Workspace>> workspaces(static_cast<std::size_t>(thread_count()));
  Progress progress("sky", tiles.count(), quiet);
  parallel_for(
      tiles.count(),
      [&](std::int64_t tile) {
        std::unique_ptr<Workspace>& work = workspaces[static_cast<std::size_t>(omp_get_thread_num())];
        if (!work) work = std::make_unique<Workspace>();
        work->sums = {};
        work->tile.load(surface, mips, options, rings, tiles.frame(tile));
        for (const AzimuthTable& azimuth : azimuths) {
          look_far(work->tile, azimuth, work->far);
          walk_sky(work->tile, azimuth, work->far, work->sums);
        }
        write_tile(*work, options.azimuths, sky);
      },
      &progress);
  return sky;
}

}  // namespace heightlight
