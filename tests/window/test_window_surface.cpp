#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "heightlight/synth.h"
#include "transport/map_gather.h"
#include "visibility/horizon_sky.h"
#include "window/held_map.h"

using namespace heightlight;

namespace {

/// A part of a synthesized map, at a relief of a quarter of the width, which puts all rings to use.
Surface part_of_fbm(int width, int height, Boundary boundary) {
  const Map all = synthesize("fbm", 512, 3);
  Heightmap map{.height = Map(width, height), .spacing = {1, 1}, .boundary = boundary};
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column)
      map.height(row, column) = 128 * all(row % 512, column % 512);
  }
  return build_surface(std::move(map));
}

void cut_holes(Surface& surface) {
  Heightmap map = surface.map;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 30; ++j) map.height(70 + i, 90 + j) = std::nanf("");
  }
  map.height(10, 11) = map.height(12, 11) = map.height(11, 10) = map.height(11, 12) = std::nanf("");
  map.height(10, 10) = map.height(12, 12) = std::nanf("");  // what is left in the middle bounds no facet
  map.height(200, 150) = std::nanf("");
  surface = build_surface(std::move(map));
}

bool same_bits(const Map& whole, const Map& part, const WindowPlace& place) {
  for (int row = 0; row < part.height; ++row) {
    if (std::memcmp(&whole(place.first_row + row, place.first_column), &part(row, 0),
                    sizeof(float) * static_cast<std::size_t>(part.width)) != 0)
      return false;
  }
  return true;
}

/// Sums of a gather, as two maps.
struct Gathered {
  Map weight;
  Map weighted;
};

Gathered gather(const MapGather& gather, const FieldPyramid& pyramid, const Map& sky) {
  Gathered gathered{Map(sky.width, sky.height), Map(sky.width, sky.height)};
  gather.run({.azimuths = 8, .turn = 0.3, .sky = &sky}, {&pyramid},
             [&](const ReceiverTile& tile, const GatherSums& sums) {
               for_present(tile, [&](std::size_t at, int row, int column) {
                 gathered.weight(row, column) = sums.weight[at];
                 gathered.weighted(row, column) = sums.weighted[0][at];
               });
             });
  return gathered;
}

void check_windows(const Surface& surface, int window) {
  const SkyPlan sky_plan{.walk = {.azimuths = 12, .samples_per_octave = 8}, .full_from = 0.2};
  const WalkOptions gather_options{.samples_per_octave = 12};
  const HeightPyramid pyramid = build_height_pyramid(surface);
  const HorizonSky sky = walk_horizon_sky(surface, pyramid, sky_plan, {.wanted = {.first = true}});
  const MapGather gather_whole(surface, pyramid, gather_options);
  FieldPyramid field = gather_whole.make_pyramid();
  field.fill(sky.sky_view_factor);
  const Gathered whole = gather(gather_whole, field, sky.sky_view_factor);

  const int level = GENERATE(1, 2, 4);
  const HeldMap heights(surface.map.height);
  const CoarseHeights coarse = coarse_heights(heights, surface.map.boundary, level, window);
  const MapParts parts = parts_of(surface, heights, coarse);
  const HeldMap stored_sky(sky.sky_view_factor);
  const CoarseField coarse_sky = complete_field(level, coarse_field_of(sky.sky_view_factor, level));
  const WindowView of_sky = window_view(parts, sky_plan.walk);
  const WindowView of_gather = window_view(parts, gather_options);
  const WindowView view{std::max(of_sky.margin, of_gather.margin), std::max(of_sky.levels, of_gather.levels)};
  for (int row = 0; row < surface.height(); row += window) {
    for (int column = 0; column < surface.width(); column += window) {
      const WindowPlace place{surface.width(),
                              surface.height(),
                              row,
                              column,
                              std::min(window, surface.width() - column),
                              std::min(window, surface.height() - row)};
      const Surface part = window_surface(parts, place, view);
      CHECK(same_bits(surface.map.height, part.map.height, place));
      const HeightPyramid none = build_height_pyramid(part);
      const HorizonSky found = walk_horizon_sky(part, none, sky_plan, {.wanted = {.first = true}});
      INFO("window at " << row << ", " << column << " of " << window << ", coarse from level " << level);
      CHECK(same_bits(sky.sky_view_factor, found.sky_view_factor, place));
      CHECK(same_bits(sky.ambient_occlusion, found.ambient_occlusion, place));
      const MapGather gather_part(part, none, gather_options);
      FieldPyramid part_field = gather_part.make_pyramid();
      fill_window_field(part, stored_sky, coarse_sky, part_field);
      const Gathered seen = gather(gather_part, part_field, found.sky_view_factor);
      CHECK(same_bits(whole.weight, seen.weight, place));
      CHECK(same_bits(whole.weighted, seen.weighted, place));
    }
  }
}

}  // namespace

TEST_CASE("Receivers of a window see what they see in the whole map, to the last bit", "[window]") {
  SECTION("a map that tiles") { check_windows(part_of_fbm(256, 192, Boundary::tile), 128); }
  SECTION("an open map whose sides no block divides") {
    check_windows(part_of_fbm(301, 233, Boundary::open), 128);
  }
  SECTION("an open map with holes") {
    Surface surface = part_of_fbm(260, 256, Boundary::open);
    cut_holes(surface);
    check_windows(surface, 192);
  }
}

TEST_CASE("A window of a curved map knows what is level there", "[window]") {
  const Surface surface = [] {
    Heightmap map = part_of_fbm(256, 192, Boundary::open).map;
    map.spacing = {4000, 4000};
    return build_surface(curve_heights(std::move(map)));
  }();
  const HeldMap heights(surface.map.height);
  const CoarseHeights coarse = coarse_heights(heights, Boundary::open, 2, 64);
  const MapParts parts = parts_of(surface, heights, coarse);
  const WalkOptions walk{.azimuths = 8, .samples_per_octave = 8};
  const Surface part = window_surface(parts, {256, 192, 64, 128, 128, 64}, window_view(parts, walk));
  for (const int row : {0, 63}) {
    const Gradient here = level_gradient(part.map, row, 17);
    const Gradient there = level_gradient(surface.map, row + 64, 17 + 128);
    CHECK(here.x == there.x);
    CHECK(here.y == there.y);
  }
}
