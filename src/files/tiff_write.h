#pragma once

#include <filesystem>

#include "files/image_file.h"

namespace heightlight {

/// Rows and columns of a tile, in samples.
constexpr int kTiffTile = 256;

/// Writes a TIFF in deflated tiles of 256 × 256, a few rows at a time; this is the part of write_texture for
/// TIFF. A layout with a georeference makes a GeoTIFF: the tags are those of the georeference to the last
/// bit, NaN becomes the no-data value that the tags name, bands carry their text as GDAL reads it, and means
/// of 2 × 2, 4 × 4 … samples follow as overviews until one tile holds everything. A file that may exceed 4 GB
/// becomes a BigTIFF. Throws OutputError naming the file.
void write_tiff(const std::filesystem::path& path, const TextureLayout& layout, const FillRows& fill);

}  // namespace heightlight
