#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "heightlight/files.h"

namespace heightlight {

/// A warning in the words of the command line, options by their names.
std::string user_message(const Warning& warning);

/// Tells them on stderr, a line each that names the map: also where the user wants no report, since results
/// hang on them.
void tell_warnings(const std::filesystem::path& map, const std::vector<Warning>& warnings);

/// Says on stdout which files of an earlier result went away, if any did.
void report_removed(const std::vector<std::string>& names);

}  // namespace heightlight
