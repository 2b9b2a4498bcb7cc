#pragma once

#include <filesystem>

#include "heightlight/files.h"

namespace heightlight {

/// Whether a file is terrain, and no material: whether it tells the distance between its samples. Esri grids
/// do, SRTM tiles whose name has a place, and TIFFs with a pixel scale. Looks at no samples; false for a file
/// that cannot be read.
bool is_terrain_file(const std::filesystem::path& path);

/// The same of a file as it is loaded: what it tells a place of, or the user a spacing and that nothing lies
/// beyond it.
bool is_loaded_as_terrain(const LoadOptions& load, const std::filesystem::path& path);

}  // namespace heightlight
