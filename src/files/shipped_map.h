#pragma once

#include <cstdint>
#include <filesystem>
#include <variant>

#include "heightlight/image.h"

namespace heightlight {

/// A map that was delivered with a material: ambient occlusion (1 = open, as the file stores it; its gamma is
/// unknown), or unit normals (x right, z out of the picture, y as the file has it).
using ShippedMap = std::variant<Map, Image<Vector3>>;

/// Reads such a map. Colours of which nearly all are unit vectors are normals; grey is ambient occlusion.
/// `memory` bytes must hold the map. Throws Error naming a file that is neither, and as load_heightmap does.
ShippedMap read_shipped_map(const std::filesystem::path& path, std::uint64_t memory);

}  // namespace heightlight
