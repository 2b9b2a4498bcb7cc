#pragma once

#include <cstdint>

#include "heightlight/heightmap.h"

namespace heightlight {

/// Returns heights above the base. Each is the mean of the heights present around it, weighted by a Gaussian
/// of standard deviation `sigma` (world units, ≥ 0; 0 leaves the heights as they are), which is cut at 4
/// sigma. A map that tiles is wrapped; open edges and holes have no weight, so that beside them the mean is
/// one-sided. NaN where the sample is missing.
Image<double> gaussian_mean(const Heightmap& map, double sigma);

/// Bytes per texel that gaussian_mean takes, its result included.
constexpr std::uint64_t kGaussianMeanBytes = 3 * sizeof(double);

}  // namespace heightlight
