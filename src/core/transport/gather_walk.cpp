#include "transport/gather_walk.h"

#include <cmath>
#include <numbers>

namespace heightlight {
namespace {

/// The numbers 0 … count − 1: first every 2^kMostHalvings-th, then those that halve the step between these,
/// and so on.
std::vector<int> spread_order(int count) {
  std::vector<int> order;
  for (int step = 1 << kMostHalvings; step > 0; step /= 2) {
    const bool coarsest = step == 1 << kMostHalvings;
    for (int k = 0; k < count; k += step) {
      if (coarsest || k % (2 * step) != 0) order.push_back(k);
    }
  }
  return order;
}

/// Copies a table's samples, near ones first, for pyramids whose level 0 has this stride.
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

int halved_azimuths(int azimuths, int halvings, int fewest) {
  while (halvings > 0 && azimuths % 2 == 0 && azimuths / 2 >= fewest) {
    azimuths /= 2;
    --halvings;
  }
  return azimuths;
}

GatherWalk make_gather_walk(const Surface& surface, const WalkOptions& options, double turn,
                            const FieldPyramid& layout) {
  GatherWalk walk{.least_rise = least_rise(options.samples_per_octave)};
  const std::ptrdiff_t stride = layout.level(0).stride();
  for (const int k : spread_order(options.azimuths)) {
    const double azimuth = 2 * std::numbers::pi * (k + turn) / options.azimuths;
    walk.azimuths.push_back(flatten(make_azimuth_table(surface, options, azimuth), stride));
  }
  return walk;
}

}  // namespace heightlight
