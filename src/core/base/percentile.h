#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace heightlight {

/// The place of a percentile among sorted values, share × (count − 1), and the linear interpolation there:
/// from the value of rank `lower` by the part `beyond`, in [0, 1), to the value of rank `upper`. The project
/// uses the word in no other sense.
struct PercentilePlace {
  std::size_t lower = 0;
  std::size_t upper = 0;
  double beyond = 0;

  /// `count` ≥ 1 values, `share` in [0, 1].
  PercentilePlace(double share, std::size_t count) {
    const double place = share * static_cast<double>(count - 1);
    lower = static_cast<std::size_t>(place);
    upper = std::min(lower + 1, count - 1);
    beyond = place - static_cast<double>(lower);
  }

  double between(double at_lower, double at_upper) const { return at_lower + (at_upper - at_lower) * beyond; }
};

/// Percentile of at least one value, none of which is NaN. Reorders the values. The first `settled` values
/// must be in their sorted places already, and below the percentile.
template <class T>
double percentile(std::span<T> values, double share, std::size_t settled = 0) {
  const auto at = [&values](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
  const PercentilePlace place(share, values.size());
  std::nth_element(at(settled), at(place.lower), values.end());
  if (place.upper != place.lower) {
    std::iter_swap(at(place.upper), std::min_element(at(place.upper), values.end()));
  }
  return place.between(static_cast<double>(values[place.lower]), static_cast<double>(values[place.upper]));
}

}  // namespace heightlight
