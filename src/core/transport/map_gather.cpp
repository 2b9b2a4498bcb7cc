#include "transport/map_gather.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>

#include "base/parallel.h"

namespace heightlight {
namespace {

/// What a thread needs to gather tile after tile.
struct Workspace {
  ReceiverTile tile;
  GatherSums sums;
};

/// The RMS of 1 − `sky` over the receivers of a block that are present; 0 of none.
double surface_share(const ReceiverTile& tile, const Map& sky, int first_row, int first_column) {
  double squares = 0;
  int present = 0;
  for (int i = first_row; i < std::min(first_row + kGatherBlockRows, tile.rows); ++i) {
    for (int j = first_column; j < std::min(first_column + kGatherBlock, tile.columns); ++j) {
      const float value = sky(tile.first_row + i, tile.first_column + j);
      if (std::isnan(value)) continue;
      squares += (1 - double{value}) * (1 - double{value});
      ++present;
    }
  }
  return present > 0 ? std::sqrt(squares / present) : 0;
}

void share_azimuths(const ReceiverTile& tile, const Map& sky, int azimuths, GatherTask& task) {
  for (int i = 0; i < tile.rows; i += kGatherBlockRows) {
    for (int j = 0; j < tile.columns; j += kGatherBlock) {
      const double share = surface_share(tile, sky, i, j);
      const int count = share > 0 ? std::max(1, azimuths >> azimuth_halvings(share)) : 0;
      task.azimuths[gather_block(i, j)] = static_cast<std::uint16_t>(count);
    }
  }
}

}  // namespace

int azimuth_halvings(double surface_share) {
  return surface_share < 0.04 ? 3 : surface_share < 0.12 ? 2 : surface_share < 0.4 ? 1 : 0;
}

MapGather::MapGather(const Surface& surface, const HeightMips& mips, const Map& sky,
                     const WalkOptions& options)
    : surface_(surface), sky_(sky), options_(options), scene_(build_horizon_scene(surface, mips, options)) {
  assert(sky.width == surface.width() && sky.height == surface.height());
}

FieldPyramid MapGather::make_pyramid() const {
  return {surface_, ring_count(surface_, options_), walk_reach(options_)};
}

void MapGather::run(const GatherTurn& turn, const std::vector<const FieldPyramid*>& fields,
                    const std::function<void(const ReceiverTile&, const GatherSums&)>& visit) const {
  const TileGrid grid(surface_.width(), surface_.height());
  std::vector<TileFrame> frames;
  for (std::int64_t i = 0; i < grid.count(); ++i) frames.push_back(grid.frame(i));
  run_on(frames, turn, fields,
         [&](std::size_t, const ReceiverTile& tile, const GatherSums& sums) { visit(tile, sums); });
}

void MapGather::run_on(
    const std::vector<TileFrame>& frames, const GatherTurn& turn,
    const std::vector<const FieldPyramid*>& fields,
    const std::function<void(std::size_t, const ReceiverTile&, const GatherSums&)>& visit) const {
  assert(!fields.empty() && fields.size() <= kMostFields);
  WalkOptions options = options_;
  options.azimuths = turn.azimuths;
  const GatherWalk walk = make_gather_walk(surface_, options, turn.turn, *fields[0]);
  std::vector<std::unique_ptr<Workspace>> workspaces(static_cast<std::size_t>(thread_count()));
  parallel_for(static_cast<std::int64_t>(frames.size()), [&](std::int64_t i) {
    std::unique_ptr<Workspace>& work = workspaces[static_cast<std::size_t>(omp_get_thread_num())];
    if (!work) work = std::make_unique<Workspace>();
    work->tile.load_receivers(surface_, 0, frames[static_cast<std::size_t>(i)]);
    GatherTask task{.tile = work->tile, .scene = scene_, .walk = walk};
    task.field_count = fields.size();
    std::copy(fields.begin(), fields.end(), task.fields.begin());
    task.highest = surface_.highest;
    share_azimuths(work->tile, sky_, turn.azimuths, task);
    walk_gather(task, work->sums);
    visit(static_cast<std::size_t>(i), work->tile, work->sums);
  });
}

std::uint64_t MapGather::bytes(const Surface& surface, const WalkOptions& options) {
  return horizon_scene_bytes(surface, options);
}

std::uint64_t MapGather::pyramid_bytes(const Surface& surface, const WalkOptions& options) {
  return field_pyramid_bytes(surface.width(), surface.height(), ring_count(surface, options),
                             walk_reach(options));
}

}  // namespace heightlight
