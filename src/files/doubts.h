#pragma once

#include "files/stored_heights.h"

namespace heightlight {

/// Finds what is odd about a loaded map: heights or slopes that are hardly ever intended, terraces, and edges
/// that do not meet although the map is to tile.
std::vector<Warning> find_doubts(const Heightmap& map, const StoredHeights& stored,
                                 const LoadOptions& options);

}  // namespace heightlight
