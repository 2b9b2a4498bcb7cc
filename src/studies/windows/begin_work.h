#pragma once

#include "windows/work.h"

namespace heightlight {

/// Bytes that the work on a window takes at most, beside the coarse levels of the map.
std::uint64_t window_bytes(const WindowGrid& grid, int first_coarse, const BakeOptions& options);

/// Begins the work of a task: its folder is made anew, with the map's heights in it, window by window.
/// `side`: texels of a window's side, a multiple of 64; 0: as many as options.memory holds. Throws as
/// load_heightmap does, UsageError for a side that is none, MemoryError naming what would do where no window
/// fits.
Work begin_work(WindowedTask task, int side);

}  // namespace heightlight
