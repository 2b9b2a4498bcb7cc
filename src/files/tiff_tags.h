#pragma once

#include <tiffio.h>

#include <filesystem>
#include <string>

#include "files/image_file.h"

namespace heightlight {

/// The tags of one image of a TIFF: the map itself, or one of its overviews, which is smaller.
void set_tiff_tags(TIFF* tiff, const TextureLayout& layout, int factor);

/// Makes libtiff know the tags of a place, which it then takes as they are.
void know_place_tags(TIFF* tiff);

/// GDAL's text on bands: descriptions and units (its tag 42112); empty where there are none.
std::string band_metadata(const std::vector<BandText>& bands);

}  // namespace heightlight
