#include "transport/gather_walk.h"

#include <cmath>
#include <numbers>

namespace heightlight {
namespace {

/// 0 … count − 1 such that the first 2^k of them, for any k that divides, are evenly spread.
std::vector<int> spread_order(int count) {
  std::vector<int> order{0};
  while (static_cast<int>(order.size()) < count && count % (2 * static_cast<int>(order.size())) == 0) {
    const int step = count / (2 * static_cast<int>(order.size()));
    const std::size_t half = order.size();
    for (std::size_t i = 0; i < half; ++i) order.push_back(order[i] + step);
  }
  const int taken = static_cast<int>(order.size());
  for (int part = 1; part < count / taken; ++part) {
    for (int i = 0; i < taken; ++i) order.push_back(order[static_cast<std::size_t>(i)] + part);
  }
  return order;
}

/// Of a table, for pyramids whose level 0 has this stride.
GatherAzimuth flatten(const AzimuthTable& table, std::ptrdiff_t stride) {
  GatherAzimuth azimuth{.world_x = table.world_x, .world_y = table.world_y, .samples = {}};
  azimuth.lifted = table.lifted;
  azimuth.near = table.near.size();
  for (const NearSample& near : table.near) {
    GatherSample& sample = azimuth.samples.emplace_back();
    sample.way = near.way;
    sample.per_distance = near.per_distance;
    sample.share = near.weight[1] / near.per_distance;
    for (int s = 0; s < 2; ++s) {
      sample.weight[s] = near.weight[s];
      sample.offset[s] = static_cast<std::int32_t>(near.row[s] * stride + near.column[s]);
    }
  }
  for (std::size_t ring = 0; ring < table.rings.size(); ++ring) {
    for (const RingSample& far : table.rings[ring]) {
      azimuth.samples.push_back({.way = far.way,
                                 .per_distance = far.per_distance,
                                 .level = ring_level(static_cast<int>(ring) + 1),
                                 .row = far.row,
                                 .column = far.column});
    }
  }
  return azimuth;
}

}  // namespace

GatherWalk make_gather_walk(const Surface& surface, const WalkOptions& options, double turn,
                            const FieldPyramid& layout) {
  GatherWalk walk;
  const std::ptrdiff_t stride = layout.level(0).stride();
  for (const int k : spread_order(options.azimuths)) {
    const double azimuth = 2 * std::numbers::pi * (k + turn) / options.azimuths;
    walk.azimuths.push_back(flatten(make_azimuth_table(surface, options, azimuth), stride));
  }
  return walk;
}

}  // namespace heightlight
