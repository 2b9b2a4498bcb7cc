#pragma once

#include "bake/bake.h"
#include "cli/bake_command.h"

namespace heightlight {

/// Whether windows can bake what is asked for.
bool can_be_windowed(const BakeCommand& command, const BakeInput& input);

/// Bakes a map window by window. The work goes on where it was, when an earlier process was stopped. Throws
/// UsageError for what windows cannot do.
BakeOutcome bake_by_windows(const BakeCommand& command, const BakeInput& input, const InputGuard& guard,
                            bool quiet);

/// Bakes the window of the map that the command names. Throws as bake_by_windows does, and UsageError for a
/// window that is none, or is not inside the map.
BakeOutcome bake_one_window(const BakeCommand& command, const BakeInput& input, const InputGuard& guard,
                            bool quiet);

}  // namespace heightlight
