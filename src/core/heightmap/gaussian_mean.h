#pragma once

#include <cstdint>

#include "heightlight/heightmap.h"

namespace heightlight {

/// Heights above the base, each the mean of those present around it, weighted by a Gaussian of standard
/// deviation `sigma` (world units, ≥ 0; 0 leaves them as they are), which is cut at 4 sigma. A map that tiles
/// is wrapped; over open edges and holes there is nothing to weigh, so that beside them the mean is
/// one-sided. NaN where the sample is missing.
Image<double> gaussian_mean(const Heightmap& map, double sigma);

/// Bytes per texel that it takes, with its result.
constexpr std::uint64_t kGaussianMeanBytes = 3 * sizeof(double);

}  // namespace heightlight
