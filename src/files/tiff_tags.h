#pragma once

#include <tiffio.h>

#include <filesystem>
#include <string>

#include "files/image_file.h"

namespace heightlight {

/// Sets the tags of one image of a TIFF: the map itself (`factor` 1), or an overview, which is smaller by
/// `factor`.
void set_tiff_tags(TIFF* tiff, const TextureLayout& layout, int factor);

/// Registers the georeference tags with libtiff, which then passes them on unchanged.
void know_place_tags(TIFF* tiff);

/// GDAL's metadata text with the descriptions and units of bands (its tag 42112); empty where there are none.
std::string band_metadata(const std::vector<BandText>& bands);

}  // namespace heightlight
