#include "terrain/terrain_truth.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "terrain/texel_slices.h"
#include "visibility/exact_walk.h"

namespace heightlight {

std::vector<std::size_t> pick_receivers(const Surface& surface, int most, std::uint64_t seed) {
  const Image<float>& height = surface.map.height;
  std::vector<std::pair<std::uint64_t, std::size_t>> present;
  for (std::size_t i = 0; i < height.size(); ++i) {
    if (!std::isnan(height.values[i])) present.emplace_back(hash_combine(seed, i), i);
  }
  const std::size_t count = std::min(present.size(), static_cast<std::size_t>(most));
  const auto end = present.begin() + static_cast<std::ptrdiff_t>(count);
  std::partial_sort(present.begin(), end, present.end());
  std::vector<std::size_t> receivers;
  for (std::size_t i = 0; i < count; ++i) receivers.push_back(present[i].second);
  std::sort(receivers.begin(), receivers.end());
  return receivers;
}

std::vector<std::vector<double>> find_exact_definitions(const Surface& surface, int azimuths,
                                                        const std::vector<std::size_t>& receivers,
                                                        const std::vector<TerrainSky>& definitions,
                                                        const Watch& watch) {
  const ExactWalker walker(surface, azimuths);
  const auto width = static_cast<std::size_t>(surface.width());
  std::vector<std::vector<double>> values(definitions.size(), std::vector<double>(receivers.size()));
  Progress progress("exact horizons", static_cast<std::int64_t>(receivers.size()), watch);
  parallel_for(
      static_cast<std::int64_t>(receivers.size()),
      [&](std::int64_t i) {
        const auto at = static_cast<std::size_t>(i);
        const std::size_t texel = receivers[at];
        std::vector<SkySum> sums(definitions.size());
        for (int k = 0; k < azimuths; ++k) {
          const double azimuth = walker.azimuth_rad(k);
          const double horizon =
              walker.horizon_rad(static_cast<int>(texel / width), static_cast<int>(texel % width), azimuth);
          const SliceNormal normal = slice_normal(surface, texel, AzimuthDirection(azimuth));
          for (std::size_t d = 0; d < definitions.size(); ++d)
            sums[d].add(definitions[d], normal, slope_of_horizon(horizon));
        }
        for (std::size_t d = 0; d < definitions.size(); ++d) values[d][at] = sums[d].value();
      },
      &progress);
  return values;
}

TerrainTruth find_terrain_truth(const Surface& surface, std::uint64_t seed, const Watch& watch) {
  std::vector<TerrainSky> definitions;
  for (const TerrainSkyText& text : terrain_skies()) definitions.push_back(text.definition);
  TerrainTruth truth;
  truth.receivers = pick_receivers(surface, kTruthReceivers, seed);
  truth.by_name = find_exact_definitions(surface, kTruthAzimuths, truth.receivers, definitions, watch);
  return truth;
}

}  // namespace heightlight
