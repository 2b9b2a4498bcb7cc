#include "transport/link_packing.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace heightlight {
namespace {

constexpr int kWhole = 255;

std::uint8_t to_byte(float unit) { return static_cast<std::uint8_t>(std::lround(unit * kWhole)); }

/// Which corners of a cell are present; corner c is the right one where c is odd, the lower one where c ≥ 2.
std::array<bool, 4> present_corners(int row, int column, const Image<float>& height) {
  std::array<bool, 4> present{};
  for (int corner = 0; corner < 4; ++corner) {
    const float value = height((row + corner / 2) % height.height, (column + corner % 2) % height.width);
    present[static_cast<std::size_t>(corner)] = !std::isnan(value);
  }
  return present;
}

void snap_to_corner(Link& link, const std::array<bool, 4>& present) {
  const Link original = link;
  int nearest = std::numeric_limits<int>::max();
  for (int corner = 0; corner < 4; ++corner) {
    const int across = kWhole * (corner % 2);
    const int down = kWhole * (corner / 2);
    const int distance = std::abs(original.across - across) + std::abs(original.down - down);
    if (!present[static_cast<std::size_t>(corner)] || distance >= nearest) continue;
    nearest = distance;
    link.across = static_cast<std::uint8_t>(across);
    link.down = static_cast<std::uint8_t>(down);
  }
}

}  // namespace

Link pack_link(std::uint16_t weight, const SurfacePoint& place, const Image<float>& height) {
  const auto width = static_cast<std::uint32_t>(height.width);
  const std::uint32_t row = place.cell / width;
  const std::uint32_t column = place.cell % width;
  Link link{row * (width + 1) + column, weight, to_byte(place.across), to_byte(place.down)};
  const std::array<bool, 4> present =
      present_corners(static_cast<int>(row), static_cast<int>(column), height);
  if (present != std::array<bool, 4>{true, true, true, true}) snap_to_corner(link, present);
  return link;
}

}  // namespace heightlight
