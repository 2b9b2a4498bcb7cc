#include <catch2/catch.hpp>
#include <cmath>

#include "heightlight/synth.h"
#include "visibility/exact_sky.h"
#include "window/held_map.h"
#include "window/paged_ground.h"

using namespace heightlight;

namespace {

/// What the bounds of cells' blocks are, as windows find them.
Map highest_of_blocks(const Surface& surface, int level) {
  const int side = 1 << level;
  Map blocks((surface.cell_columns() + side - 1) / side, (surface.cell_rows() + side - 1) / side, -1e30F);
  for (int row = 0; row < surface.cell_rows(); ++row) {
    for (int column = 0; column < surface.cell_columns(); ++column) {
      for (int down = 0; down < 2; ++down) {
        for (int right = 0; right < 2; ++right) {
          const float height =
              surface.map.height((row + down) % surface.height(), (column + right) % surface.width());
          float& highest = blocks(row / side, column / side);
          highest = std::fmax(highest, height);
        }
      }
    }
  }
  return blocks;
}

}  // namespace

TEST_CASE("Exact walks over ground that is stored see what they see over ground in memory", "[window]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const int level = GENERATE(1, 3);
  Heightmap map{.height = synthesize("brick", 160, 4), .spacing = {0.01, 0.01}, .boundary = boundary};
  for (float& height : map.height.values) height *= 0.2F;
  for (int i = 0; i < 9; ++i) map.height(40, 50 + i) = std::nanf("");
  const Surface surface = build_surface(std::move(map));
  const HeldMap stored(surface.map.height);
  const PagedGround ground(stored, surface.map.spacing, boundary, 40000);  // two pages: they come and go
  Surface header = surface;
  header.map.height.values.clear();
  header.normal = {};
  const ExactWalker in_memory(surface, 24);
  const ExactWalker on_disk(header, 24, ground,
                            complete_maximum_pyramid(level, highest_of_blocks(surface, level),
                                                     surface.cell_columns(), surface.cell_rows()),
                            level);
  for (int i = 0; i < 40; ++i) {
    const int row = 37 * i % 160;
    const int column = 61 * i % 160;
    const ExactSky expected = find_exact_sky(in_memory, row, column);
    const ExactSky found = find_exact_sky(on_disk, row, column);
    if (std::isnan(expected.sky_view_factor)) {
      CHECK(std::isnan(found.sky_view_factor));
      continue;
    }
    CHECK(found.sky_view_factor == expected.sky_view_factor);
    CHECK(found.ambient_occlusion == expected.ambient_occlusion);
    SliceView expected_view;
    SliceView found_view;
    in_memory.view(row, column, expected_view);
    on_disk.view(row, column, found_view);
    REQUIRE(found_view.links.size() == expected_view.links.size());
    for (std::size_t k = 0; k < found_view.links.size(); ++k) {
      CHECK(found_view.links[k].weight == expected_view.links[k].weight);
      CHECK(found_view.links[k].place.cell == expected_view.links[k].place.cell);
    }
  }
}

TEST_CASE("fBm made by rows is fBm", "[window][synth]") {
  const FbmRows rows(96, 5);
  const Map whole = synthesize("fbm", 96, 5);
  const Map part = rows.rows(30, 17);
  for (int row = 0; row < 17; ++row) {
    for (int column = 0; column < 96; ++column) CHECK(part(row, column) == whole(row + 30, column));
  }
}
