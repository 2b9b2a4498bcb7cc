#pragma once

#include <cmath>
#include <vector>

#include "curves/bin_groups.h"

namespace heightlight {

/// Mean, spread and range of `count` values. The mean is kept as a value about there and what is missing to
/// it, so that a narrow spread about a large mean keeps its digits.
struct Moments {
  double count = 0;
  double about = 0;
  double offset = 0;
  double squares = 0;  ///< Σ (value − mean)²
  double least = 0;
  double greatest = 0;

  double mean() const { return about + offset; }
  double stddev() const { return std::sqrt(squares / count); }
};

/// The moments of each filled bin, in double precision; the same to the last bit for any number of threads.
/// `map` has a value per texel; T is float or double.
template <class T>
std::vector<Moments> bin_moments(const BinGroups& groups, const T* map);

}  // namespace heightlight
