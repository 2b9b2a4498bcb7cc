#pragma once

#include <vector>

#include "files/input_file.h"
#include "heightlight/files.h"

namespace heightlight {

/// The distance between samples of a map with `rows` rows, in the unit of its heights, which is metres where
/// the file does not say. Cells in degrees are measured on the WGS 84 ellipsoid at the map's middle latitude,
/// and a warning says so. Throws Error, with the remedy `texel`, where cells are in degrees without a
/// latitude or not on the Earth, or where the unit of cells is not the metre and the unit of heights is
/// unknown.
Spacing spacing_on_ground(const InputFile& file, const Georeference& place, int rows,
                          std::vector<Warning>& warnings);

}  // namespace heightlight
