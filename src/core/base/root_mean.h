#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace heightlight {

/// √(squares / count); 0 for a count of 0.
inline double root_mean(double squares, std::size_t count) {
  return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0;
}

/// Root of the mean square of the values; 0 where there are none.
inline double root_mean_square(const std::vector<double>& values) {
  double squares = 0;
  for (const double value : values) squares += value * value;
  return root_mean(squares, values.size());
}

}  // namespace heightlight
