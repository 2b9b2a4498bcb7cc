#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/hash.h"
#include "base/parallel.h"
#include "heightlight/surface.h"

namespace heightlight {

/// Receivers of a surface, as indices into its maps, in the order in which they are evaluated.
using Receivers = std::vector<std::size_t>;

/// Picks `count` receivers from all over the map by a hash; errors are measured at them.
inline Receivers pick_receivers(const Surface& surface, int count) {
  Receivers receivers(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    receivers[i] = scramble(i) % surface.map.height.size();
  }
  return receivers;
}

/// Whole rows, in the order in which a simulation visits them: one from each of `rows` equal bands of the
/// map, at a position in the band chosen by a hash. They represent the map for methods that are too slow to
/// be timed on all of it. (Rows at equal distances might coincide with the courses of a wall.) With 32 rows,
/// the time extrapolated to the benchmarks' maps was within 7 % of what all of their rows took.
inline Receivers row_receivers(const Surface& surface, int rows) {
  const auto band = static_cast<std::size_t>(surface.height() / rows);
  const auto width = static_cast<std::size_t>(surface.width());
  Receivers receivers;
  for (std::size_t i = 0; i < static_cast<std::size_t>(rows); ++i) {
    const std::size_t row = i * band + scramble(i) % band;
    for (std::size_t column = 0; column < width; ++column) receivers.push_back(row * width + column);
  }
  return receivers;
}

/// Root mean square of the differences.
inline double rmse(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
    sum += difference * difference;
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// Calls body(begin, end) for runs of neighbours among `count` receivers, on all threads.
template <class Body>
void for_runs(std::size_t count, Body&& body) {
  constexpr std::size_t kRun = 64;
  parallel_for(static_cast<std::int64_t>((count + kRun - 1) / kRun), [&](std::int64_t run) {
    const std::size_t begin = static_cast<std::size_t>(run) * kRun;
    body(begin, std::min(begin + kRun, count));
  });
}

}  // namespace heightlight
