#pragma once

#include "window/stored_map.h"
#include "windows/work.h"

namespace heightlight {

/// Bakes a window of a map, and writes files of its size. Receivers look at the whole map: at its samples
/// nearby, at the blocks of its coarse levels farther off. Where they are as many texels as the plan was made
/// for, A is that of the whole map to the last bit. Light that comes from beyond the window and task.halo
/// texels around it is that of the map's coarse levels alone, which are solved as a map of their own. Throws
/// as bake_material does, UsageError for a window that is not inside the map, or for what windows cannot do
/// (check_windowed).
BakeOutcome bake_window(const WindowedTask& task, const MapRect& window, const BakeTarget& target);

}  // namespace heightlight
