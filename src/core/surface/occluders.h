#pragma once

#include "heightlight/surface.h"

namespace heightlight {

/// Are there samples that bound no facet, for want of neighbours: at holes, or on a map of one row or column?
bool has_loose_samples(const Surface& surface);

/// The heights of the samples that bound a facet, and so may stand in somebody's way; NaN elsewhere.
Image<float> occluding_heights(const Surface& surface);

}  // namespace heightlight
