#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "base/percentile.h"

namespace heightlight {

inline constexpr std::array<double, 3> kPercentileShares{0.05, 0.50, 0.95};

/// p05, p50 and p95.
using Percentiles = std::array<double, kPercentileShares.size()>;

/// Of at least one value. They are reordered; their order does not matter.
template <class T>
Percentiles exact_percentiles(std::span<T> values) {
  Percentiles result{};
  std::size_t settled = 0;  // those before it are in their places
  for (std::size_t s = 0; s < result.size(); ++s) {
    result[s] = percentile(values, kPercentileShares[s], settled);
    settled = PercentilePlace(kPercentileShares[s], values.size()).lower;
  }
  return result;
}

}  // namespace heightlight
