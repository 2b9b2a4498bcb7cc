#include "visibility/reach_table.h"

#include <algorithm>
#include <cmath>

#include "heightlight/error.h"

namespace heightlight {

void check_reach(const Reach& reach) {
  if (!(reach.distance > 0) || !std::isfinite(reach.distance)) {
    throw UsageError("max_distance", "", "must be a positive number");
  }
  constexpr double kLongest = 1e12;  // its square is a single-precision number
  if (reach.distance < 1 / kLongest || reach.distance > kLongest)
    throw UsageError("max_distance", "", "must be from 1e-12 to 1e12");
}

ReachTable make_reach_table(const AzimuthTable& azimuth, const Reach& sphere) {
  const double distance = sphere.distance;
  const auto reach = static_cast<float>(distance);
  ReachTable table{reach, reach * reach, -1e4F * reach, sphere.falloff, 0, {}};
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
  while (needed < rings && std::ldexp(2 * options.fineness, needed + 1) < texels) ++needed;
  return needed;
}

}  // namespace heightlight
