#pragma once

#include "windows/work.h"

namespace heightlight {

/// Throws UsageError for a window's side that is none: it must be a multiple of kTileSide, or 0.
void check_side(int side);

/// Bytes that the work on a window takes at most, beside the coarse levels of the map.
std::uint64_t window_bytes(const WindowGrid& grid, int first_coarse, const BakeOptions& options);

/// Throws MemoryError where options.memory does not hold windows of so many texels a side.
void check_window_memory(const Work& work, int side);

/// Begins the work of a task: its folder is made anew, with the map's heights in it, window by window.
/// `side`: texels of a window's side, a multiple of 64; 0: as many as options.memory holds. Throws as
/// load_heightmap does, UsageError for a side that is none, MemoryError naming what would do where no window
/// fits.
Work begin_work(WindowedTask task, int side);

/// The same for a map of which these facts are known, the grid's side and first_coarse aside, and whose
/// heights are made by the first step.
Work begin_work_of(WindowedTask task, int side, const WorkFacts& facts);

/// Bytes that a process at work on one window takes at most, all that it holds included.
std::uint64_t process_bytes(const Work& work);

}  // namespace heightlight
