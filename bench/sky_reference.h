#pragma once

#include "time_to_error.h"

namespace heightlight {

/// The converged sky view factor at `count` receivers: the mean of two runs of 65536 rays with different
/// seeds.
struct SkyReference {
  ReferenceValues reference;
  double own_rmse = 0;  ///< RMSE of the mean, estimated from the difference of the two runs
};
SkyReference make_sky_reference(const Surface& surface, int count);

}  // namespace heightlight
