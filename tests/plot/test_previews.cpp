#include <catch2/catch.hpp>
#include <cmath>

#include "plot/previews.h"

using namespace heightlight;

TEST_CASE("A grey picture is sRGB encoded, clipped, and magenta where nothing is known", "[plot]") {
  Map map(5, 1);
  map.values = {0.0F, 0.5F, 1.0F, 7.0F, NAN};
  const Image<Rgb8> picture = grey_picture(map);
  REQUIRE(picture.width == 5);
  REQUIRE(picture.height == 1);
  CHECK(picture(0, 0) == Rgb8{0, 0, 0});
  CHECK(picture(0, 1) == Rgb8{188, 188, 188});  // IEC 61966-2-1 of 0.5
  CHECK(picture(0, 2) == Rgb8{255, 255, 255});
  CHECK(picture(0, 3) == Rgb8{255, 255, 255});
  CHECK(picture(0, 4) == kMissingColour);
}

TEST_CASE("A large map is averaged to at most 512 texels a side, missing ones left out", "[plot]") {
  Map map(1024, 256, 1.0F);
  map(0, 0) = NAN;
  for (int column = 0; column < 4; ++column) map(10, 100 + column) = 0;
  for (int column : {200, 201}) map(20, column) = map(21, column) = NAN;
  const Image<Rgb8> picture = grey_picture(map);
  CHECK(picture.width == 512);
  CHECK(picture.height == 128);
  CHECK(picture(0, 0) == Rgb8{255, 255, 255});
  CHECK(picture(5, 50) == Rgb8{188, 188, 188});
  CHECK(picture(10, 100) == kMissingColour);

  const Image<Rgb8> line = grey_picture(Map(5000, 1, 0.0F));
  CHECK(line.width == 512);
  CHECK(line.height == 1);
}

TEST_CASE("Three channels make a colour", "[plot]") {
  const Image<Rgb8> picture = colour_picture({Map(2, 3, 1.0F), Map(2, 3, 0.0F), Map(2, 3, 0.5F)});
  CHECK(picture == Image<Rgb8>(2, 3, Rgb8{255, 0, 188}));
}

TEST_CASE("Bounces stand side by side with a gap, on one scale", "[plot]") {
  const Image<Rgb8> strip = picture_strip(
      {grey_picture(Map(10, 4, 1.0F)), grey_picture(Map(10, 4, 0.5F)), grey_picture(Map(10, 4, 0.0F))});
  CHECK(strip.width == 3 * 10 + 2 * 8);
  CHECK(strip.height == 4);
  CHECK(strip(3, 9) == Rgb8{255, 255, 255});
  CHECK(strip(3, 18) == Rgb8{188, 188, 188});
  CHECK(strip(0, 36) == Rgb8{0, 0, 0});
  CHECK(picture_strip({}).size() == 0);
}

TEST_CASE("A height picture is brightest on slopes that face the upper left, and marks holes", "[plot]") {
  Heightmap map;
  map.height = Image<float>(9, 9);
  map.spacing = {1, 1};
  map.boundary = Boundary::open;
  for (int row = 0; row < 9; ++row) {
    for (int column = 0; column < 9; ++column)
      map.height(row, column) = static_cast<float>(4 - std::abs(column - 4));
  }
  map.height(0, 0) = NAN;
  const Image<Rgb8> picture = height_picture(build_surface(map));
  CHECK(picture(4, 2)[0] > picture(4, 4)[0]);
  CHECK(picture(4, 4)[0] > picture(4, 6)[0]);
  CHECK(picture(0, 0) == kMissingColour);
}
