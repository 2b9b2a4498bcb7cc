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

/// RMS of 1 − `sky` over the receivers present in a block; 0 if there are none.
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

void share_azimuths(const ReceiverTile& tile, const GatherTurn& turn, GatherTask& task) {
  task.azimuths.fill(static_cast<std::uint16_t>(turn.azimuths));
  if (!turn.sky) return;
  for (int i = 0; i < tile.rows; i += kGatherBlockRows) {
    for (int j = 0; j < tile.columns; j += kGatherBlock) {
      const double share = surface_share(tile, *turn.sky, i, j);
      const int count = share > 0 ? halved_azimuths(turn.azimuths, azimuth_halvings(share), turn.fewest) : 0;
      task.azimuths[gather_block(i, j)] = static_cast<std::uint16_t>(count);
    }
  }
}

}  // namespace

int azimuth_halvings(double surface_share) {
  static_assert(kMostHalvings == 3);
  return surface_share < 0.04 ? 3 : surface_share < 0.12 ? 2 : surface_share < 0.4 ? 1 : 0;
}

MapGather::MapGather(const Surface& surface, const HeightPyramid& pyramid, const WalkOptions& options)
    : surface_(surface), options_(options), scene_(build_horizon_scene(surface, pyramid, options)) {}

FieldPyramid MapGather::make_pyramid() const {
  // Up to a level of one block, so that holes find a value. The holes of windows have been filled already.
  const int to_one = surface_.around ? 0 : levels_to_one(surface_.width(), surface_.height());
  return {surface_, std::max(ring_count(surface_, options_), to_one), walk_margin(options_)};
}

void MapGather::run(const GatherTurn& turn, const std::vector<const FieldPyramid*>& fields,
                    const std::function<void(const ReceiverTile&, const GatherSums&)>& visit,
                    const Watch& watch) const {
  const TileGrid grid(surface_.width(), surface_.height());
  std::vector<TileFrame> frames;
  for (std::int64_t i = 0; i < grid.count(); ++i) frames.push_back(grid.frame(i));
  run_on(
      frames, turn, fields,
      [&](std::size_t, const ReceiverTile& tile, const GatherSums& sums) { visit(tile, sums); }, watch);
}

void MapGather::run_on(const std::vector<TileFrame>& frames, const GatherTurn& turn,
                       const std::vector<const FieldPyramid*>& fields,
                       const std::function<void(std::size_t, const ReceiverTile&, const GatherSums&)>& visit,
                       const Watch& watch) const {
  assert(!fields.empty() && fields.size() <= kMostFields);
  WalkOptions options = options_;
  options.azimuths = turn.azimuths;
  const GatherWalk walk = make_gather_walk(surface_, options, turn.turn, *fields[0]);
  std::vector<std::unique_ptr<Workspace>> workspaces(static_cast<std::size_t>(thread_count()));
  const auto count = static_cast<std::int64_t>(frames.size());
  const Watch silent{.tell = {}, .stopped = watch.stopped};
  Progress progress("gather", count, silent);
  const auto walk_frame = [&](std::int64_t i) {
    std::unique_ptr<Workspace>& work = workspaces[static_cast<std::size_t>(omp_get_thread_num())];
    if (!work) work = std::make_unique<Workspace>();
    work->tile.load_receivers(surface_, 0, frames[static_cast<std::size_t>(i)]);
    GatherTask task{.tile = work->tile, .scene = scene_, .walk = walk};
    task.field_count = fields.size();
    std::copy(fields.begin(), fields.end(), task.fields.begin());
    task.highest = surface_.highest;
    share_azimuths(work->tile, turn, task);
    walk_gather(task, work->sums);
    visit(static_cast<std::size_t>(i), work->tile, work->sums);
  };
  parallel_for(count, walk_frame, &progress);
}

std::uint64_t gather_bytes(int width, int height, std::uint64_t fields) {
  const int margin = walk_margin({.samples_per_octave = 24});
  const std::uint64_t pyramid = field_pyramid_bytes(width, height, levels_to_one(width, height), margin);
  return (1 + fields) * pyramid + field_pyramid_bytes(width, height, 0, margin);
}

}  // namespace heightlight
