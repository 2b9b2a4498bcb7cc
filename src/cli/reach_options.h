#pragma once

#include <string>
#include <vector>

#include "heightlight/visibility.h"

namespace heightlight {

/// "0.05", or "5%" of a width: a length. Throws UsageError for what is neither, naming the quantity.
double parse_distance(const std::string& quantity, const std::string& text, double width);

/// Names of falloffs, as options have them.
const std::vector<std::string>& falloff_names();

/// One of them.
Falloff parse_falloff(const std::string& name);

}  // namespace heightlight
