#pragma once

#include <cstddef>

#include "heightlight/image.h"

namespace heightlight {

/// The distinct values of a map.
struct Levels {
  std::size_t count = 0;  ///< kMostLevels + 1 means more than kMostLevels
  double step = 0;  ///< median distance between neighbouring levels; 0 if there are more than kFewLevels
};
constexpr std::size_t kFewLevels = 1024;

/// Counts the distinct values. NaN is not a level; −0 is the same as 0.
Levels count_levels(const Image<double>& values);

}  // namespace heightlight
