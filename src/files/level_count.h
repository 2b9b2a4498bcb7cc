#pragma once

#include "heightlight/image.h"

namespace heightlight {

/// Distinct values among those that are not NaN, up to kMostLevels; kMostLevels + 1 where there are more.
std::size_t count_levels(const Image<double>& values);

}  // namespace heightlight
