#pragma once

#include <string>
#include <vector>

#include "fit/judged_map.h"

namespace heightlight {

/// The RMS error below which no function of some inputs can come on these texels: the spread of the totals
/// inside fine cells of those inputs, unbiased by the cells' own means; each map counts alike.
struct Floor {
  std::string inputs;       ///< "alpha", "A", "alpha+A", "A+map" (another function for each map), "A+blur"
  std::vector<double> rms;  ///< per judged albedo
};

/// Over 256 cells of one input, or 128 × 128 of two. Empty where no map has texels.
std::vector<Floor> find_floors(const std::vector<JudgedMap>& maps);

}  // namespace heightlight
