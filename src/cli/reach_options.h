#pragma once

#include <string>

namespace heightlight {

/// "0.05", or "5%" of a width: a length. Throws UsageError for what is neither, naming the quantity.
double parse_distance(const std::string& quantity, const std::string& text, double width);

}  // namespace heightlight
