#pragma once

#include "files/stored_heights.h"

namespace heightlight {

/// What is odd about a map as it was loaded: heights or slopes that hardly anyone means, terraces, edges that
/// do not meet where the map is to tile.
std::vector<Warning> find_doubts(const Heightmap& map, const StoredHeights& stored,
                                 const LoadOptions& options);

}  // namespace heightlight
