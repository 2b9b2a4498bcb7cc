#pragma once

#include "heightlight/georeference.h"

namespace heightlight {

/// Whether the cells of a grid that does not say so are angles: its extent lies within the longitudes
/// [−180, 360] and latitudes [−90, 90], its cells are finer than half a degree, its corner is not the bare
/// origin, and its heights (metres) span more than its larger side, which in one common unit would be a slope
/// of 45° from end to end. `relief` is the span of the values present.
bool looks_like_degrees(const Georeference& place, int columns, int rows, double relief);

/// Lengths in metres of steps in degrees, east and north, at a latitude in degrees (WGS 84).
Spacing degrees_in_metres(const Spacing& degrees, double latitude);

}  // namespace heightlight
