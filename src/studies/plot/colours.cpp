#include "plot/colours.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace heightlight {

std::string ordered_colour(double share) {
  using Stop = std::array<double, 3>;
  constexpr std::array<Stop, 7> kStops{{{68, 1, 84},
                                        {70, 50, 126},
                                        {54, 92, 141},
                                        {39, 127, 142},
                                        {31, 161, 135},
                                        {74, 193, 109},
                                        {160, 218, 57}}};
  const double at = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const std::size_t first = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  const double part = at - static_cast<double>(first);
  const auto level = [&](std::size_t c) {
    return std::lround((1 - part) * kStops[first][c] + part * kStops[first + 1][c]);
  };
  return fmt::format("#{:02x}{:02x}{:02x}", level(0), level(1), level(2));
}

std::string order_style(std::size_t place, std::size_t last) {
  const double share = static_cast<double>(place) / static_cast<double>(std::max<std::size_t>(1, last));
  return fmt::format("lc rgb '{}'", ordered_colour(share));
}

}  // namespace heightlight
