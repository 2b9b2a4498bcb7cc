#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "transport/gather_walk.h"
#include "visibility/horizon_scene.h"

namespace heightlight {

using WalkGather = void (*)(const GatherTask&, GatherSums&);

/// The sums of a gather over a whole map, per texel in row-major order.
struct GatheredMap {
  std::vector<float> weight;
  std::vector<std::vector<float>> weighted;  ///< per field

  /// Of what the texel sees of a field. NaN where it sees nothing.
  double mean(std::size_t field, std::size_t texel) const {
    return double{weighted[field][texel]} / double{weight[texel]};
  }
};

/// Gathers tile after tile with a kernel of one's choice, all azimuths everywhere.
inline GatheredMap gather_with(WalkGather walk, const Surface& surface, const WalkOptions& options,
                               const std::vector<Map>& fields) {
  const HorizonScene scene = build_horizon_scene(surface, build_height_pyramid(surface), options);
  const int levels = std::max(ring_count(surface, options), levels_to_one(surface.width(), surface.height()));
  std::vector<FieldPyramid> pyramids;
  for (const Map& field : fields) pyramids.emplace_back(surface, levels, walk_margin(options)).fill(field);
  const GatherWalk azimuths = make_gather_walk(surface, options, 0.25, pyramids[0]);
  GatheredMap result;
  result.weight.resize(surface.map.height.size());
  result.weighted.assign(fields.size(), result.weight);
  const auto tile = std::make_unique<ReceiverTile>();
  const auto sums = std::make_unique<GatherSums>();
  const TileGrid grid(surface.width(), surface.height());
  for (std::int64_t i = 0; i < grid.count(); ++i) {
    tile->load_receivers(surface, 0, grid.frame(i));
    GatherTask task{.tile = *tile, .scene = scene, .walk = azimuths};
    task.field_count = fields.size();
    for (std::size_t f = 0; f < fields.size(); ++f) task.fields[f] = &pyramids[f];
    task.azimuths.fill(static_cast<std::uint16_t>(options.azimuths));
    task.highest = surface.highest;
    walk(task, *sums);
    for (int row = 0; row < tile->rows; ++row) {
      for (int column = 0; column < tile->columns; ++column) {
        const auto at = static_cast<std::size_t>(row * ReceiverTile::kSide + column);
        const std::size_t texel =
            surface.map.height.index(tile->first_row + row, tile->first_column + column);
        result.weight[texel] = sums->weight[at];
        for (std::size_t f = 0; f < fields.size(); ++f) result.weighted[f][texel] = sums->weighted[f][at];
      }
    }
  }
  return result;
}

}  // namespace heightlight
