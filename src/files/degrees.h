#pragma once

#include "files/esri_grid.h"
#include "heightlight/files.h"

namespace heightlight {

/// Whether a grid's cell size is an angle: its extent lies within the longitudes [−180, 360] and latitudes
/// [−90, 90], its cells are finer than half a degree, its corner is not the bare origin, and its heights
/// (metres) span more than its larger side, which in one common unit would be a slope of 45° from end to end.
/// `relief` is the span of the values present.
bool is_in_degrees(const EsriHeader& header, double relief);

/// Lengths in metres of steps in degrees, east and north, at a latitude in degrees (WGS 84).
Spacing degrees_in_metres(const Spacing& degrees, double latitude);

/// Cell size in metres at the middle latitude of a grid in degrees (WGS 84).
Spacing cell_in_metres(const EsriHeader& header);

}  // namespace heightlight
