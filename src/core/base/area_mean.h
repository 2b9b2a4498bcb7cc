#pragma once

#include "heightlight/image.h"

namespace heightlight {

/// The map resampled to width × height texels. Each texel is the mean of the values present in its rectangle
/// of `map`, NaN where there is none. A side that is larger than the map's repeats texels. All sizes are at
/// least 1.
Map area_mean(const Map& map, int width, int height);

}  // namespace heightlight
