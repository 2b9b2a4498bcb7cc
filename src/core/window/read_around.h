#pragma once

#include "heightlight/heightmap.h"
#include "window/stored_map.h"

namespace heightlight {

/// A rectangle that may go on beyond the edges of a map: with the samples of its other side where it tiles,
/// NaN elsewhere.
Map read_around(const StoredMap& stored, Boundary boundary, const MapRect& rect);

}  // namespace heightlight
