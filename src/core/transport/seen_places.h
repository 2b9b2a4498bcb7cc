#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/hash.h"
#include "heightlight/surface.h"

namespace heightlight {

/// Rows that tell as much of a map of so many as all of them: all, or of large maps some 256, picked by a
/// hash.
inline std::vector<int> seen_rows(int height) {
  constexpr int kEnoughRows = 256;
  constexpr std::uint64_t kSeed = 1;
  const int step = std::max(1, height / kEnoughRows);
  std::vector<int> rows;
  for (int first = 0; first < height; first += step) {
    const int count = std::min(step, height - first);
    const auto pick = static_cast<int>(hash_combine(kSeed, static_cast<std::uint64_t>(first)) %
                                       static_cast<std::uint64_t>(count));
    rows.push_back(first + pick);
  }
  return rows;
}

/// Calls visit(i, 1 − A, area) for receivers of the map, whose texels weigh 1/n_z, their area, in seen_rows.
/// One after the other, so that sums are the same for any number of threads. `sky` is A, NaN where missing.
template <class Visit>
void for_seen_places(const Map& sky, const Surface& surface, Visit&& visit) {
  for (const int row : seen_rows(sky.height)) {
    const std::size_t begin = sky.index(row, 0);
    for (std::size_t i = begin; i < begin + static_cast<std::size_t>(sky.width); ++i) {
      if (!std::isnan(sky.values[i]))
        visit(i, 1 - double{sky.values[i]}, 1 / double{surface.normal.values[i].z});
    }
  }
}

}  // namespace heightlight
