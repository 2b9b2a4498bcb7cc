#include "visibility/reach_table.h"

#include <algorithm>
#include <cmath>

#include "core/gauss_legendre.h"
#include "heightlight/error.h"

namespace heightlight {

std::vector<ReachNode> reach_nodes(const Reach& reach, int nodes) {
  if (!(reach.distance > 0) || !std::isfinite(reach.distance)) {
    throw UsageError("--max-distance must be a positive number");
  }
  if (reach.falloff == Falloff::none) return {{reach.distance, 1}};
  std::vector<ReachNode> result;
  for (const QuadratureNode& node : gauss_legendre(nodes)) {
    const double share = reach.falloff == Falloff::root ? node.at * node.at : node.at;
    result.push_back({share * reach.distance, static_cast<float>(node.weight)});
  }
  return result;
}

ReachTable make_reach_table(const AzimuthTable& azimuth, double distance) {
  ReachTable table;
  const auto reach = static_cast<float>(distance);
  table.squared = reach * reach;
  table.deepest = -1e4F * reach;
  while (table.near < azimuth.near.size() && 1 / azimuth.near[table.near].per_distance < reach) ++table.near;
  table.near = std::min(table.near + 1, azimuth.near.size());
  for (const std::vector<RingSample>& ring : azimuth.rings) {
    std::vector<float>& caps = table.caps.emplace_back();
    for (const RingSample& sample : ring) {
      const double away = 1 / double{sample.per_distance};
      if (away >= distance) break;
      caps.push_back(static_cast<float>(std::sqrt(distance * distance - away * away) / away));
    }
    if (caps.size() < ring.size()) break;
  }
  return table;
}

int rings_within(const Surface& surface, const WalkOptions& options, double distance, int rings) {
  const double texels = distance / std::min(surface.map.spacing.x, surface.map.spacing.y);
  int needed = 0;
  while (needed < rings && std::ldexp(options.fineness, needed + 1) < texels) ++needed;
  return needed;
}

}  // namespace heightlight
