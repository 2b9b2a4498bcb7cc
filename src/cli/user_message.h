#pragma once

#include <exception>
#include <string>

#include "heightlight/error.h"

namespace heightlight {

/// An error as the user of the command line is told it: quantities by the names of their options, and the
/// option that would help, if one would, at the end.
std::string user_message(const Error& error);

/// Likewise of anything that work may throw, that of libraries included.
std::string user_message(const std::exception& error);

}  // namespace heightlight
