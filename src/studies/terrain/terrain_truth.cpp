#include "terrain/terrain_truth.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "solve/definitions.h"
#include "visibility/exact_sky.h"

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

std::vector<double> find_exactly(const Surface& surface, int azimuths,
                                 const std::vector<std::size_t>& receivers, const TerrainQuantity& quantity,
                                 const Watch& watch) {
  const ExactWalker walker(surface, azimuths);
  const auto width = static_cast<std::size_t>(surface.width());
  std::vector<double> values(receivers.size());
  Progress progress("exact horizons", static_cast<std::int64_t>(receivers.size()), watch);
  parallel_for(
      static_cast<std::int64_t>(receivers.size()),
      [&](std::int64_t i) {
        const auto at = static_cast<std::size_t>(i);
        const int row = static_cast<int>(receivers[at] / width);
        const int column = static_cast<int>(receivers[at] % width);
        values[at] = is_of_sky(quantity.definition)
                         ? find_exact_sky(walker, row, column, {}, quantity.below).sky_view_factor
                         : exact_horizon_means(
                               walker, row, column)[static_cast<std::size_t>(mean_of(quantity.definition))];
      },
      &progress);
  return values;
}

TerrainTruth find_terrain_truth(const Surface& surface, std::uint64_t seed, const Watch& watch) {
  TerrainTruth truth;
  truth.receivers = pick_receivers(surface, kTruthReceivers, seed);
  for (const TerrainQuantity& quantity : terrain_quantities())
    truth.values.push_back(find_exactly(surface, kTruthAzimuths, truth.receivers, quantity, watch));
  return truth;
}

const std::vector<double>& TerrainTruth::of(const TerrainQuantity& quantity) const {
  const std::vector<TerrainQuantity>& all = terrain_quantities();
  return values[static_cast<std::size_t>(std::find(all.begin(), all.end(), quantity) - all.begin())];
}

}  // namespace heightlight
