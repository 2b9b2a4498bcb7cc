#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace heightlight {

inline constexpr std::array<double, 3> kPercentileShares{0.05, 0.50, 0.95};

/// p05, p50 and p95.
using Percentiles = std::array<double, kPercentileShares.size()>;

/// A percentile is an order statistic, linearly interpolated at share × (count − 1): `beyond` of the way from
/// the one of rank `lower` to that of rank `upper`.
struct PercentilePlace {
  std::size_t lower = 0;
  std::size_t upper = 0;
  double beyond = 0;

  PercentilePlace(double share, std::size_t count) {
    const double place = share * static_cast<double>(count - 1);
    lower = static_cast<std::size_t>(place);
    upper = std::min(lower + 1, count - 1);
    beyond = place - static_cast<double>(lower);
  }

  double between(double at_lower, double at_upper) const { return at_lower + (at_upper - at_lower) * beyond; }
};

/// Of at least one value. They are reordered; their order does not matter.
template <class T>
Percentiles exact_percentiles(std::span<T> values) {
  Percentiles result{};
  const auto at = [&values](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
  std::size_t settled = 0;  // those before it are in their places
  for (std::size_t s = 0; s < result.size(); ++s) {
    const PercentilePlace place(kPercentileShares[s], values.size());
    std::nth_element(at(settled), at(place.lower), values.end());
    if (place.upper != place.lower) {
      std::iter_swap(at(place.upper), std::min_element(at(place.upper), values.end()));
    }
    result[s] =
        place.between(static_cast<double>(values[place.lower]), static_cast<double>(values[place.upper]));
    settled = place.lower;
  }
  return result;
}

}  // namespace heightlight
