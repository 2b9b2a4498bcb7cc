#include "window/paged_ground.h"

#include "window/read_around.h"

namespace heightlight {

PagedGround::PagedGround(const StoredMap& heights, Spacing spacing, Boundary boundary, std::uint64_t bytes)
    : heights_(heights), spacing_(spacing), boundary_(boundary), paged_(heights, bytes) {}

Vector3 PagedGround::normal(int row, int column) const {
  const Surface around =
      build_surface({.height = read_around(heights_, boundary_, {row - 1, column - 1, 3, 3}),
                     .spacing = spacing_,
                     .boundary = Boundary::open});
  return around.normal(1, 1);
}

}  // namespace heightlight
