#pragma once

#include <string>

#include "heightlight/error.h"

namespace heightlight {

/// An error as the user of the command line is told it: quantities by the names of their options, and the
/// option that would help, if one would, at the end.
std::string user_message(const Error& error);

}  // namespace heightlight
