#pragma once

#include <filesystem>

#include "files/image_file.h"

namespace heightlight {

/// Rows and columns of a tile.
constexpr int kTiffTile = 256;

/// Writes a TIFF in deflated tiles of 256 × 256, some rows at a time: what write_texture does for TIFF. A
/// layout with a place makes a GeoTIFF: its tags are those of the place, to the last bit, floats that are NaN
/// become the no-data value that they name, bands have their text as GDAL reads it, and means of 2 × 2, 4 × 4
/// … samples follow as overviews until one tile holds all. What may exceed 4 GB becomes a BigTIFF. Throws
/// OutputError naming the file.
void write_tiff(const std::filesystem::path& path, const TextureLayout& layout, const FillRows& fill);

}  // namespace heightlight
