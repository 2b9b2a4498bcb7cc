#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "heightlight/transport.h"

namespace heightlight {

/// A vertex of the facet that a link ends on, and its weight in linear interpolation there.
struct LinkCorner {
  std::uint64_t row;  ///< of the map; may lie beyond its edge, where tiling wraps it
  std::uint64_t column;
  double share;
};

/// The four vertices of the link's cell. At most three have shares above 0; the shares sum to 1.
inline std::array<LinkCorner, 4> corners_of(const Link& link, int map_width) {
  const auto stride = static_cast<std::uint64_t>(map_width) + 1;
  const std::uint64_t row = link.cell / stride;
  const std::uint64_t column = link.cell % stride;
  const double across = link.across / 255.0;
  const double down = link.down / 255.0;
  const double both = std::min(across, down);
  return {{{row, column, 1 - std::max(across, down)},
           {row, column + 1, across - both},
           {row + 1, column, down - both},
           {row + 1, column + 1, both}}};
}

}  // namespace heightlight
