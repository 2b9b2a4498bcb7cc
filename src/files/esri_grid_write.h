#pragma once

#include <filesystem>

#include "files/image_file.h"

namespace heightlight {

/// Writes an Esri ASCII grid: `layout` has one channel. Its header has the place's corner and cell, or the
/// origin and `spacing`; values have as many digits as a float needs, and NaN becomes the place's no-data
/// value, or −9999. Throws OutputError naming the file.
void write_esri_grid(const std::filesystem::path& path, const TextureLayout& layout, const Spacing& spacing,
                     const FillRows& fill);

}  // namespace heightlight
