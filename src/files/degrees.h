#pragma once

#include "heightlight/georeference.h"

namespace heightlight {

/// Guesses whether the cells of a grid are angles, where the grid does not say so. They are taken for degrees
/// if the extent lies within the longitudes [−180, 360] and latitudes [−90, 90], the cells are finer than
/// half a degree, the corner is not the bare origin, and the heights (metres) span more than the larger side
/// of the grid. In one common unit, such heights would mean a slope of 45° from end to end. `relief` is the
/// difference between the highest and the lowest present value.
bool looks_like_degrees(const Georeference& place, int columns, int rows, double relief);

/// Converts steps of `degrees` (east and north) at a latitude in degrees into lengths in metres (WGS 84).
Spacing degrees_in_metres(const Spacing& degrees, double latitude);

}  // namespace heightlight
