#include "visibility/distance_table.h"

#include <algorithm>
#include <cmath>

#include "heightlight/error.h"

namespace heightlight {

void check_maximum_distance(const MaximumDistance& maximum_distance) {
  if (!(maximum_distance.distance > 0) || !std::isfinite(maximum_distance.distance)) {
    throw UsageError("max_distance", "", "must be a positive number");
  }
  constexpr double kLongest = 1e12;  // its square is a single-precision number
  if (maximum_distance.distance < 1 / kLongest || maximum_distance.distance > kLongest)
    throw UsageError("max_distance", "", "must be from 1e-12 to 1e12");
}

DistanceTable make_distance_table(const AzimuthTable& azimuth, const MaximumDistance& sphere) {
  const double distance = sphere.distance;
  const auto maximum_distance = static_cast<float>(distance);
  DistanceTable table{
      maximum_distance, maximum_distance * maximum_distance, -1e4F * maximum_distance, sphere.falloff, 0, {}};
  while (table.near < azimuth.near.size() && 1 / azimuth.near[table.near].per_distance < maximum_distance)
    ++table.near;
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
  while (needed < rings && std::ldexp(2 * options.samples_per_octave, needed + 1) < texels) ++needed;
  return needed;
}

}  // namespace heightlight
