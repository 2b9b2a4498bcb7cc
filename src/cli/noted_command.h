#pragma once

#include <string>

namespace heightlight {

/// An argument as a shell reads it: as it is where nothing in it means anything to a shell, else in single
/// quotes; $'…' (bash, zsh, ksh) where it holds controls or bytes that are no UTF-8.
std::string shell_quoted(const std::string& argument);

/// Remembers the command line of this process, which reports tell. The name of the program becomes
/// "heightlight", wherever it was found.
void note_command(int argument_count, const char* const* arguments);

/// That command line, quoted for a shell; empty before it is noted.
const std::string& noted_command();

}  // namespace heightlight
