#pragma once

#include <optional>
#include <string>
#include <vector>

#include "heightlight/georeference.h"

namespace heightlight {

/// What the tags of a TIFF say of its place, or why that cannot be used.
struct GeotiffPlace {
  std::optional<Georeference> place;
  std::string fault;  ///< words that go on after the file's name; empty where nothing is wrong
};

/// Reads ModelPixelScaleTag with ModelTiepointTag, or ModelTransformationTag, and the keys (OGC GeoTIFF 1.1,
/// section 7). Neither a place nor a fault where there is none of these. A fault: tags of another type or
/// number of values than the standard's, scales that are not positive, grids that are rotated, sheared or
/// upside down, places by control points, tags or units that contradict each other, latitudes beyond the
/// poles.
GeotiffPlace read_geotiff_place(const std::vector<GeoTag>& tags, int rows);

/// The place of a part of the map that begins at a sample.
Georeference crop_place(const Georeference& place, int row, int column);

/// The same place for means of factor × factor samples.
Georeference shrink_place(const Georeference& place, int factor);

}  // namespace heightlight
