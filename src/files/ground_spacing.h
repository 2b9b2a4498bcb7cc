#pragma once

#include <vector>

#include "files/input_file.h"
#include "heightlight/files.h"

namespace heightlight {

/// The distance between samples of a map of so many rows, in the unit of its heights: metres where the file
/// does not say what that is. Cells in degrees are measured on the WGS 84 ellipsoid at the map's middle
/// latitude, and `warnings` says so. Throws Error, with a remedy of `texel`, where degrees come without a
/// latitude, or lengths in feet with heights whose unit is not told.
Spacing spacing_on_ground(const InputFile& file, const Georeference& place, int rows,
                          std::vector<Warning>& warnings);

}  // namespace heightlight
