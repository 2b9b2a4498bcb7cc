#pragma once

#include "heightlight/image.h"

namespace heightlight {

/// How a map differs from a reference, over the texels where both have a value. All 0 where there is none.
struct ErrorStatistics {
  double rmse = 0;
  double bias = 0;     ///< mean of map − reference
  double p99 = 0;      ///< 99 % of the texels differ by no more
  double largest = 0;  ///< of |map − reference|
};

/// Peak signal-to-noise ratio in dB of values in [0, 1]: −20 log₁₀ RMSE; infinite where nothing differs.
double peak_signal_to_noise(const ErrorStatistics& error);

/// Map − reference; NaN where either has no value.
Map subtract(const Map& map, const Map& reference);

/// Angle between unit vectors, degrees; NaN where either has no value.
Map angles_deg(const Image<Vector3>& vectors, const Image<Vector3>& reference);

/// The n of thin_out.
int thinning_step(int width, int height);

/// Every n-th texel of every n-th row, so that no side has more than 256 and noise stays what it is.
Map thin_out(const Map& map);

/// Of a map of differences.
ErrorStatistics measure(const Map& differences);

}  // namespace heightlight
