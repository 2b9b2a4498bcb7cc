#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "heightlight/watch.h"
#include "visibility/distance_table.h"
#include "visibility/walk_tile.h"

namespace heightlight {

/// The table of an azimuth, and the part of it that lies within the maximum distance, if there is one.
struct RouteAzimuth {
  AzimuthTable table;
  std::optional<DistanceTable> maximum_distance;
};

/// Azimuths to walk along, with everything that all tiles share.
struct Route {
  std::vector<RouteAzimuth> azimuths;
  int rings = 0;
};

/// φ_k of the options, k = 0 … K − 1, rad.
std::vector<double> walked_azimuths(const WalkOptions& options);

/// Plans the route along the given azimuths (rad). Throws UsageError as check_maximum_distance does.
Route plan_route(const Surface& surface, const WalkOptions& options, const std::vector<double>& azimuths,
                 const std::optional<MaximumDistance>& maximum_distance);

/// All tiles of a map.
std::vector<TileFrame> all_tiles(const Surface& surface);

/// A walk from the receivers of some tiles, and the name under which its progress is reported.
struct RouteStep {
  const Route& route;
  const std::vector<TileFrame>& tiles;
  const char* label;
  const Watch& watch;
};

/// Loads tile after tile into a workspace's `tile` and calls visit(workspace, index) for each, on all
/// threads.
template <class Workspace, class Visit>
void for_tiles(const Surface& surface, const HeightPyramid& pyramid, const WalkOptions& options,
               const RouteStep& step, Visit&& visit) {
  std::vector<std::unique_ptr<Workspace>> workspaces(static_cast<std::size_t>(thread_count()));
  const auto count = static_cast<std::int64_t>(step.tiles.size());
  Progress progress(step.label, count, step.watch);
  parallel_for(
      count,
      [&](std::int64_t i) {
        const auto tile = static_cast<std::size_t>(i);
        std::unique_ptr<Workspace>& work = workspaces[static_cast<std::size_t>(omp_get_thread_num())];
        if (!work) work = std::make_unique<Workspace>();
        work->tile.load(surface, pyramid, options, step.route.rings, step.tiles[tile]);
        visit(*work, tile);
      },
      &progress);
}

}  // namespace heightlight
