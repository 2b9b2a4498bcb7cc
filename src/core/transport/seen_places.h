#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/hash.h"
#include "heightlight/surface.h"

namespace heightlight {

/// Rows that represent a map of `height` rows: all rows, or of large maps about 256 that a hash picks, one
/// from each group of neighbouring rows.
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

/// Calls visit(i, 1 − A, area) for the receivers present in seen_rows. `area` is 1/n_z, the texel's surface
/// area in units of its area on the map. The calls follow one after the other, so that sums are the same for
/// any number of threads. `sky` is A, NaN where missing.
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
