#pragma once

#include <algorithm>

#include "heightlight/surface.h"
#include "visibility/exact_walk.h"

namespace heightlight {

/// Index of the texel nearest to a place.
inline std::size_t nearest_texel(const SurfacePoint& place, const Surface& surface) {
  const auto width = static_cast<std::uint32_t>(surface.width());
  const int row = static_cast<int>(place.cell / width) + (place.down > 0.5F ? 1 : 0);
  const int column = static_cast<int>(place.cell % width) + (place.across > 0.5F ? 1 : 0);
  return surface.map.height.index(row % surface.height(), column % surface.width());
}

/// x at the place of a link, interpolated linearly on its facet. `value(i)` is x of texel i, finite
/// everywhere; values at missing samples have weight only where rounding puts a place beyond a hole's edge.
template <class Value>
double value_seen(const VisibleInterval& link, const Surface& surface, Value&& value) {
  const SurfacePoint& place = link.place;
  const int row = static_cast<int>(place.cell / static_cast<std::uint32_t>(surface.width()));
  const int column = static_cast<int>(place.cell % static_cast<std::uint32_t>(surface.width()));
  const auto corner = [&](int down, int right) -> double {
    return value(
        surface.map.height.index((row + down) % surface.height(), (column + right) % surface.width()));
  };
  const double across = place.across;
  const double down = place.down;
  const double both = std::min(across, down);
  const double upper_left = corner(0, 0);
  return upper_left + (across - both) * (corner(0, 1) - upper_left) +
         (down - both) * (corner(1, 0) - upper_left) + both * (corner(1, 1) - upper_left);
}

/// Σ F x over what an exact walk saw.
template <class Value>
double gather_exactly(const SliceView& view, const Surface& surface, Value&& value) {
  double sum = 0;
  for (const VisibleInterval& link : view.links) sum += link.weight * value_seen(link, surface, value);
  return sum;
}

}  // namespace heightlight
