#pragma once

#include "time_to_error.h"

namespace heightlight {

/// The converged sky view factor at `count` receivers: the mean of two runs of 65536 rays that are turned
/// differently.
struct SkyReference {
  ReferenceValues reference;
  double own_rmse = 0;  ///< of the mean, from how far the two are apart
};
SkyReference make_sky_reference(const Surface& surface, int count);

}  // namespace heightlight
