#pragma once

#include "windows/work.h"

namespace heightlight {

/// Texels of a crop's side: room for light to go astray in, and little beside the map.
constexpr int kCropSide = 1024;

/// A crop in a window's middle: what that is planned on.
MapRect middle_crop(const MapRect& window, const WindowGrid& grid);

/// The plan of a crop, as a map of its own.
HorizonPlan plan_on(const Work& work, const MapRect& crop);

}  // namespace heightlight
