#pragma once

#include <cstdint>
#include <filesystem>
#include <variant>

#include "heightlight/image.h"

namespace heightlight {

/// A map that a material came with: ambient occlusion, 1 = open, as the file stores it (no gamma is known),
/// or unit normals, x right, z out of the picture, y as the file has it.
using ShippedMap = std::variant<Map, Image<Vector3>>;

/// Reads such a map: colours of which nearly all are unit vectors are normals, grey is occlusion. `memory`
/// bytes must hold it. Throws Error naming the file that is neither, and as load_heightmap does.
ShippedMap read_shipped_map(const std::filesystem::path& path, std::uint64_t memory);

}  // namespace heightlight
