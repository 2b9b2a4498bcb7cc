#pragma once

#include <filesystem>
#include <functional>

#include "heightlight/files.h"

namespace heightlight {

/// Takes rows of heights from `first` on; `map` has all that load_heightmap finds, but for the heights, of
/// which it knows the size alone.
using TakeRows = std::function<void(const Heightmap& map, int first, const Map& rows)>;

/// load_heightmap of a TIFF that memory need not hold, row by row from the top. The heights are the same to
/// the last bit. It reads the file two or three times, knows nothing of `shrink`, wants a channel to be
/// chosen where there are several, and leaves out the warnings for which all samples would have to be
/// compared. Throws as load_heightmap does.
LoadedHeightmap load_heightmap_by_rows(const std::filesystem::path& path, const LoadOptions& options,
                                       const TakeRows& take);

}  // namespace heightlight
