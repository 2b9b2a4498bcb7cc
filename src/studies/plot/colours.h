#pragma once

#include <cstddef>
#include <string>

namespace heightlight {

/// '#rrggbb' on a viridis without its palest end, dark at 0, light at 1: for lines of an ordered family.
std::string ordered_colour(double share);

/// "lc rgb '#rrggbb'" of the `place`-th line of those up to `last`.
std::string order_style(std::size_t place, std::size_t last);

}  // namespace heightlight
