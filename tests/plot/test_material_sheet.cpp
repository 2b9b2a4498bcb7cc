#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "files/picture_text.h"
#include "heightlight/solve.h"
#include "plot/lit_sphere.h"
#include "plot/material_sheet.h"
#include "test_maps.h"

namespace heightlight {
namespace {

std::size_t count(const Image<Rgb8>& picture, const Rgb8& colour) {
  return static_cast<std::size_t>(std::count(picture.values.begin(), picture.values.end(), colour));
}

TEST_CASE("text is drawn where it is to be, as wide as it says, and cut at the edge", "[plot]") {
  constexpr Rgb8 kInk{200, 10, 20};
  Image<Rgb8> picture(120, 30);
  draw_text(picture, 4, 10, "AO 0.5", 2, kInk);
  const int width = text_width("AO 0.5", 2);
  CHECK(count(picture, kInk) > 50);
  for (int row = 0; row < picture.height; ++row) {
    for (int column = 0; column < picture.width; ++column) {
      const bool inside = row >= 4 && row < 4 + 18 && column >= 10 && column < 10 + width;
      if (!inside) REQUIRE(picture(row, column) == Rgb8{});
    }
  }
  Image<Rgb8> small(8, 4);
  draw_text(small, 2, -3, "wide \xc3\xa9", 3, kInk);
  CHECK(small.size() == 32);
}

TEST_CASE("a smooth white sphere is brightest toward the lamp, and has its ground around it", "[plot]") {
  const Map zero(8, 8, 0);
  const Map one(8, 8, 1);
  constexpr Rgb8 kGround{9, 9, 9};
  const Image<Rgb8> sphere = lit_sphere(
      {.normal_x = zero, .normal_y = zero, .normal_z = one, .occlusion = one, .reflected = {Map(8, 8, 0.5F)}},
      64, kGround);
  CHECK(sphere(0, 0) == kGround);
  CHECK(sphere(63, 63) == kGround);
  CHECK(sphere(18, 20)[0] > sphere(32, 32)[0]);
  CHECK(sphere(32, 32)[0] > sphere(48, 48)[0]);
  CHECK(sphere(18, 20)[0] < 255);
  const Image<Rgb8> red = lit_sphere({.normal_x = zero,
                                      .normal_y = zero,
                                      .normal_z = one,
                                      .occlusion = one,
                                      .reflected = {Map(8, 8, 0.5F), zero, zero}},
                                     64, kGround);
  CHECK(red(32, 32)[0] == sphere(32, 32)[0]);
  CHECK(red(32, 32)[1] == 0);
}

TEST_CASE("a sheet shows maps of any shape, holes and all, the same every time", "[plot]") {
  const auto [width, height] =
      GENERATE(std::pair{48, 48}, std::pair{64, 32}, std::pair{5, 700}, std::pair{1, 1});
  const Surface surface = build_surface(make_rough_map(width, height, Boundary::open, 0.02, 0.05, 2));
  const Results results =
      solve(surface, {.wanted = {.sky = true, .moments = {.first = true}, .totals = {{.constant = {0.5}}}}});
  const std::vector<Map> totals{results.sky_view_factor};
  const Albedo albedo{.constant = {0.7, 0.4, 0.2}};
  const SheetMaterial material{.surface = surface,
                               .occlusion = results.sky_view_factor,
                               .first_moment = results.moments.first,
                               .totals = totals,
                               .albedo = albedo,
                               .name = "rough"};
  const Image<Rgb8> sheet = draw_material_sheet(material);
  CHECK(sheet.width > 1600);
  CHECK(sheet.values.size() == sheet.size());
  CHECK(sheet == draw_material_sheet(material));
  if (width > 1) CHECK(std::set<Rgb8>(sheet.values.begin(), sheet.values.end()).size() > 100);
}

}  // namespace
}  // namespace heightlight
