#pragma once

#include <filesystem>

namespace heightlight {

/// Whether a file is terrain, and no material: whether it tells the distance between its samples. Esri grids
/// do, SRTM tiles whose name has a place, and TIFFs with a pixel scale. Looks at no samples; false for a file
/// that cannot be read.
bool is_terrain_file(const std::filesystem::path& path);

}  // namespace heightlight
