#pragma once

#include <string>

#include "heightlight/watch.h"

namespace heightlight {

/// Draws a bar with the time left on stderr, on a terminal only, and only for steps of more than a second;
/// and ends work when a noted signal came. `quiet` draws nothing. `context` stands before every step: where
/// in a longer job this work is.
Watch terminal_watch(bool quiet, const std::string& context = "");

}  // namespace heightlight
