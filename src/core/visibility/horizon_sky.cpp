#include "visibility/horizon_sky.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "visibility/horizon_slope.h"
#include "visibility/sky_walk.h"
#include "visibility/walk_route.h"

namespace heightlight {
namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

/// What a thread needs to walk tile after tile.
struct Workspace {
  WalkTile tile;
  SkySums sums;
  FarView far;
};

void walk_azimuth(const RouteAzimuth& azimuth, Workspace& work) {
  if (azimuth.maximum_distance)
    return walk_sky_within(work.tile, azimuth.table, *azimuth.maximum_distance, work.sums);
  look_far(work.tile, azimuth.table, work.far);
  walk_sky(work.tile, azimuth.table, work.far, work.sums);
}

/// Calls write(texel of the map, index in the tile) for each receiver inside the map.
template <class Write>
void for_receivers(const WalkTile& tile, const Map& map, Write&& write) {
  for (int i = 0; i < tile.rows; ++i) {
    for (int j = 0; j < tile.columns; ++j) {
      write(map.index(tile.first_row + i, tile.first_column + j),
            static_cast<std::size_t>(i * WalkTile::kSide + j));
    }
  }
}

/// Walks every other azimuth, then the rest in the blocks whose surface_share is at least `full_from`.
void walk_sparsely(const Route& route, double full_from, Workspace& work) {
  for (std::size_t k = 0; k < route.azimuths.size(); k += 2) walk_azimuth(route.azimuths[k], work);
  for (std::size_t block = 0; block < work.sums.blocks.size(); ++block) {
    work.sums.blocks[block] = surface_share(work.tile, work.sums, block) >= full_from;
  }
  if (work.sums.blocks.none()) return;
  for (std::size_t k = 1; k < route.azimuths.size(); k += 2) walk_azimuth(route.azimuths[k], work);
}

void write_tile(const Workspace& work, int azimuths, HorizonSky& sky) {
  const SkySums& sums = work.sums;
  for_receivers(work.tile, sky.sky_view_factor, [&](std::size_t texel, std::size_t at) {
    const bool present = work.tile.present[at];
    const float full = present ? sums.full[at] : kMissing;
    sky.sky_view_factor.values[texel] = present ? std::clamp(sums.sky[at] / full, 0.0F, 1.0F) : kMissing;
    const bool all = sums.blocks[sky_block(static_cast<int>(at) / WalkTile::kSide,
                                           static_cast<int>(at) % WalkTile::kSide)];
    const auto walked = static_cast<float>(all ? azimuths : azimuths / 2);
    sky.ambient_occlusion.values[texel] =
        present ? std::clamp(sums.solid[at] / walked, 0.0F, 1.0F) : kMissing;
    if (sums.wanted.first) {
      sky.moments.first.values[texel] = {sums.first[0][at] / full, sums.first[1][at] / full,
                                         sums.first[2][at] / full};
    }
    if (sums.wanted.second) {
      for (std::size_t k = 0; k < 5; ++k) sky.moments.second.values[texel][k] = sums.second[k][at] / full;
    }
  });
}

}  // namespace

double surface_share(const WalkTile& tile, const SkySums& sums, std::size_t block) {
  const int top = static_cast<int>(block) / kSkyBlocksAcross * kSkyBlockRows;
  const int left = static_cast<int>(block) % kSkyBlocksAcross * kSkyBlockColumns;
  double squares = 0;
  int present = 0;
  for (int i = top; i < std::min(top + kSkyBlockRows, tile.rows); ++i) {
    for (int j = left; j < std::min(left + kSkyBlockColumns, tile.columns); ++j) {
      const auto at = static_cast<std::size_t>(i * WalkTile::kSide + j);
      if (!tile.present[at]) continue;
      const double share = 1 - double{sums.sky[at]} / double{sums.full[at]};
      squares += share * share;
      ++present;
    }
  }
  return present > 0 ? std::sqrt(squares / present) : 0;
}

HorizonSky walk_horizon_sky(const Surface& surface, const HeightPyramid& pyramid, const SkyPlan& plan,
                            const SkyTask& task, const Watch& watch) {
  assert(plan.full_from <= 0 || plan.walk.azimuths % 4 == 0);
  const WalkOptions& options = plan.walk;
  const Route route = plan_route(surface, options, walked_azimuths(options), task.maximum_distance);
  const std::vector<TileFrame> tiles = all_tiles(surface);
  const RouteStep step{.route = route, .tiles = tiles, .label = "sky", .watch = watch};
  const int width = surface.width();
  const int height = surface.height();
  HorizonSky sky{Map(width, height), Map(width, height), {}};
  if (task.wanted.first) sky.moments.first = Image<Vector3>(width, height);
  if (task.wanted.second) sky.moments.second = Image<std::array<float, 5>>(width, height);
  for_tiles<Workspace>(surface, pyramid, options, step, [&](Workspace& work, std::size_t) {
    work.sums.wanted = task.wanted;
    work.sums.below = task.below;
    work.sums.steep = steep_slope(plan.full_from > 0 ? options.azimuths / 2 : options.azimuths);
    work.sums.clear();
    if (plan.full_from > 0) {
      walk_sparsely(route, plan.full_from, work);
    } else {
      for (const RouteAzimuth& azimuth : route.azimuths) walk_azimuth(azimuth, work);
    }
    write_tile(work, options.azimuths, sky);
  });
  return sky;
}

std::uint64_t horizon_sky_bytes(const SkyWanted& wanted) {
  return sizeof(float) * (2 + (wanted.first ? 3 : 0) + (wanted.second ? 5 : 0));
}

std::vector<Map> walk_horizons(const Surface& surface, const HeightPyramid& pyramid,
                               const WalkOptions& options, const std::vector<double>& azimuths,
                               const std::optional<MaximumDistance>& maximum_distance, const Watch& watch) {
  std::optional<MaximumDistance> sharp = maximum_distance;
  if (sharp) sharp->falloff = Falloff::none;
  const Route route = plan_route(surface, options, azimuths, sharp);
  const std::vector<TileFrame> tiles = all_tiles(surface);
  const RouteStep step{.route = route, .tiles = tiles, .label = "horizons", .watch = watch};
  std::vector<Map> horizons(azimuths.size(), Map(surface.width(), surface.height()));
  for_tiles<Workspace>(surface, pyramid, options, step, [&](Workspace& work, std::size_t) {
    work.sums.keep_slope = true;
    work.sums.clear();
    for (std::size_t k = 0; k < route.azimuths.size(); ++k) {
      walk_azimuth(route.azimuths[k], work);
      for_receivers(work.tile, horizons[k], [&](std::size_t texel, std::size_t at) {
        const float level = level_slope(work.tile, route.azimuths[k].table, at);
        horizons[k].values[texel] = work.tile.present[at] ? std::atan(work.sums.slope[at] - level) : kMissing;
      });
    }
  });
  return horizons;
}

}  // namespace heightlight
