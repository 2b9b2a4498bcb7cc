#pragma once

#include "heightlight/image.h"

namespace heightlight {

/// The map on width × height texels, of which each holds the mean of the values present in its rectangle of
/// the map's; NaN where none is. A side that is larger than the map's repeats texels. All sizes at least 1.
Map area_mean(const Map& map, int width, int height);

}  // namespace heightlight
