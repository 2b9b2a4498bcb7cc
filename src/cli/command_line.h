#pragma once

namespace heightlight {

/// Runs `heightlight ARGUMENTS…`: the exit code is 0 when done, 1 when it could not be done, 2 for wrong
/// usage, and 128 + signal when interrupted. Errors are one line on stderr.
int run_command_line(int argument_count, const char* const* arguments);

}  // namespace heightlight
