#pragma once

#include <optional>
#include <string>
#include <vector>

#include "heightlight/georeference.h"

namespace heightlight {

/// The georeference that the tags of a TIFF give, or the reason why it cannot be used.
struct GeotiffPlace {
  std::optional<Georeference> place;
  std::string fault;  ///< continues a sentence after the file's name; empty where nothing is wrong
};

/// Reads ModelPixelScaleTag with ModelTiepointTag, or ModelTransformationTag, and the GeoTIFF keys (OGC
/// GeoTIFF 1.1, section 7). Returns neither a georeference nor a fault where these tags are absent. Faults
/// are tags whose type or number of values is not the standard's, scales that are not positive, grids that
/// are rotated, sheared or upside down, georeferencing by control points, tags or units that contradict each
/// other, and latitudes beyond the poles.
GeotiffPlace read_geotiff_place(const std::vector<GeoTag>& tags, int rows);

/// The georeference of the part of the map that begins at the sample (row, column).
Georeference crop_place(const Georeference& place, int row, int column);

/// The georeference of the map after each factor × factor samples are averaged into one.
Georeference shrink_place(const Georeference& place, int factor);

}  // namespace heightlight
