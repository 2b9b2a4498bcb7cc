#pragma once

#include <filesystem>

#include "heightlight/files.h"

namespace heightlight {

/// Whether a file is terrain rather than a material, that is, whether it states the distance between its
/// samples. Esri grids do, SRTM tiles whose name gives a position, and TIFFs with a pixel scale. Reads no
/// samples; false for a file that cannot be read.
bool is_terrain_file(const std::filesystem::path& path);

/// Whether a file, loaded with these options, is terrain: is_terrain_file holds and the boundary is not set
/// to `tile`, or the user gives a texel and the boundary `open`.
bool is_loaded_as_terrain(const LoadOptions& load, const std::filesystem::path& path);

}  // namespace heightlight
