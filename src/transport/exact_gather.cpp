#include "transport/exact_gather.h"

#include <algorithm>

namespace heightlight {
namespace {

/// Linear interpolation of values per texel at a place on the surface.
double value_at(const SurfacePoint& place, const TexelVector& values, const Surface& surface) {
  const int row = static_cast<int>(place.cell / static_cast<std::uint32_t>(surface.width()));
  const int column = static_cast<int>(place.cell % static_cast<std::uint32_t>(surface.width()));
  const auto corner = [&](int down, int right) {
    const std::int64_t i = (row + down) % surface.height();
    return values[i * surface.width() + (column + right) % surface.width()];
  };
  const double across = place.across;
  const double down = place.down;
  const double both = std::min(across, down);
  const double upper_left = corner(0, 0);
  return upper_left + (across - both) * (corner(0, 1) - upper_left) +
         (down - both) * (corner(1, 0) - upper_left) + both * (corner(1, 1) - upper_left);
}

}  // namespace

double gather_exactly(const SliceView& view, const TexelVector& x, const Surface& surface) {
  double sum = 0;
  for (const VisibleInterval& link : view.links) sum += link.weight * value_at(link.place, x, surface);
  return sum;
}

}  // namespace heightlight
