#pragma once

#include <filesystem>
#include <functional>

#include "heightlight/files.h"

namespace heightlight {

/// Receives consecutive rows of heights, the first of which is row `first`. `map` has everything that
/// load_heightmap finds except the heights; only their size is set.
using TakeRows = std::function<void(const Heightmap& map, int first, const Map& rows)>;

/// As load_heightmap, for a TIFF that need not fit in memory: passes the heights to `take`, a few rows at a
/// time from the top. The heights are identical to the last bit. Reads the file two or three times. Does not
/// support `shrink`, requires a channel to be chosen where there are several, and omits the warnings that
/// would need a comparison of all samples. Throws as load_heightmap does.
LoadedHeightmap load_heightmap_by_rows(const std::filesystem::path& path, const LoadOptions& options,
                                       const TakeRows& take);

}  // namespace heightlight
