#pragma once

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "heightlight/surface.h"

namespace heightlight {

/// Calls visit(i, 1 − A, area) for receivers of the map, whose texels weigh 1/n_z, their area: for all of
/// them, or of large maps for those of some 256 rows, picked by a hash, which tell as much. One after the
/// other, so that sums are the same for any number of threads. `sky` is A, NaN where missing.
template <class Visit>
void for_seen_places(const Map& sky, const Surface& surface, Visit&& visit) {
  constexpr int kEnoughRows = 256;
  constexpr std::uint64_t kSeed = 1;
  const int step = std::max(1, sky.height / kEnoughRows);
  for (int first = 0; first < sky.height; first += step) {
    const int rows = std::min(step, sky.height - first);
    const auto pick = static_cast<int>(hash_combine(kSeed, static_cast<std::uint64_t>(first)) %
                                       static_cast<std::uint64_t>(rows));
    const std::size_t begin = sky.index(first + pick, 0);
    for (std::size_t i = begin; i < begin + static_cast<std::size_t>(sky.width); ++i) {
      if (!std::isnan(sky.values[i]))
        visit(i, 1 - double{sky.values[i]}, 1 / double{surface.normal.values[i].z});
    }
  }
}

}  // namespace heightlight
