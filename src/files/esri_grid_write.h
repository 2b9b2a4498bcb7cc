#pragma once

#include <filesystem>

#include "files/image_file.h"

namespace heightlight {

/// Writes an Esri ASCII grid; `layout` must have one channel. The header gets the corner and cell size of the
/// layout's georeference, or the origin and `spacing` where it has none. Values have as many digits as a
/// float needs; NaN becomes the georeference's no-data value, or −9999. Throws OutputError naming the file.
void write_esri_grid(const std::filesystem::path& path, const TextureLayout& layout, const Spacing& spacing,
                     const FillRows& fill);

}  // namespace heightlight
