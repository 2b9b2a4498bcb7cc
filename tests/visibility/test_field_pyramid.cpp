#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "test_maps.h"
#include "visibility/field_pyramid.h"
#include "visibility/height_pyramid.h"

namespace heightlight {
namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

Surface level_surface(int width, int height, Boundary boundary) {
  return build_surface(make_map(width, height, boundary, [](int, int) { return 0.0; }));
}

/// 10 × row + column.
Map numbered(int width, int height) {
  Map map(width, height);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) map(row, column) = static_cast<float>(10 * row + column);
  }
  return map;
}

/// Of any block, in the margin too.
float at(const FieldPyramid& pyramid, int l, int row, int column) {
  const FieldPyramid::Level& level = pyramid.level(l);
  REQUIRE((row >= -level.margin && row < level.height + level.margin));
  REQUIRE((column >= -level.margin && column < level.width + level.margin));
  return level.origin()[row * level.stride() + column];
}

TEST_CASE("each block of a field is the mean of its parts, on sides of any size", "[visibility][field]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const Surface surface = level_surface(5, 3, boundary);
  FieldPyramid pyramid(surface, 3, 1);
  pyramid.fill(numbered(5, 3));
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 5; ++column)
      REQUIRE(at(pyramid, 0, row, column) == static_cast<float>(10 * row + column));
  }
  REQUIRE(pyramid.level(1).width == 3);
  REQUIRE(pyramid.level(1).height == 2);
  CHECK(at(pyramid, 1, 0, 0) == 5.5F);   // of 0, 1, 10, 11
  CHECK(at(pyramid, 1, 0, 2) == 9);      // of 4, 14
  CHECK(at(pyramid, 1, 1, 1) == 22.5F);  // of 22, 23
  CHECK(at(pyramid, 1, 1, 2) == 24);
  REQUIRE(pyramid.level(2).width == 2);
  REQUIRE(pyramid.level(2).height == 1);
  CHECK(at(pyramid, 2, 0, 0) == 0.25F * (5.5F + 7.5F + 20.5F + 22.5F));
  CHECK(at(pyramid, 2, 0, 1) == 0.5F * (9 + 24));
  REQUIRE(pyramid.level(3).width == 1);
  CHECK(at(pyramid, 3, 0, 0) == 0.5F * (at(pyramid, 2, 0, 0) + at(pyramid, 2, 0, 1)));
}

TEST_CASE("beyond the edges of a map that tiles a field goes on with the other side", "[visibility][field]") {
  const auto [width, height] = GENERATE(std::pair{8, 4}, std::pair{5, 3}, std::pair{1, 2});
  const Surface surface = level_surface(width, height, Boundary::tile);
  constexpr int kReach = 11;  // more than once around
  FieldPyramid pyramid(surface, 2, kReach);
  pyramid.fill(numbered(width, height));
  const int levels = width == 8 ? 2 : 0;  // those at which whole blocks tile
  for (int l = 0; l <= levels; ++l) {
    const int across = width >> l;
    const int down = height >> l;
    for (int row = -kReach; row < down + kReach; ++row) {
      for (int column = -kReach; column < across + kReach; ++column) {
        const int inner_row = (row + kReach * down) % down;
        const int inner_column = (column + kReach * across) % across;
        REQUIRE(at(pyramid, l, row, column) == at(pyramid, l, inner_row, inner_column));
      }
    }
  }
  // Where blocks do not tile, the one that holds the middle sample stands: −1, which is 4.
  if (width == 5) CHECK(at(pyramid, 1, 0, -1) == at(pyramid, 1, 0, 2));
}

TEST_CASE("beyond the edges of an open map a field's outermost values stand", "[visibility][field]") {
  const Surface surface = level_surface(5, 3, Boundary::open);
  constexpr int kReach = 4;
  FieldPyramid pyramid(surface, 2, kReach);
  pyramid.fill(numbered(5, 3));
  for (int l = 0; l <= 2; ++l) {
    const FieldPyramid::Level& level = pyramid.level(l);
    for (int row = -kReach; row < level.height + kReach; ++row) {
      for (int column = -kReach; column < level.width + kReach; ++column) {
        REQUIRE(at(pyramid, l, row, column) ==
                at(pyramid, l, std::clamp(row, 0, level.height - 1), std::clamp(column, 0, level.width - 1)));
      }
    }
  }
}

TEST_CASE("where samples are missing a field has the value of the block around them", "[visibility][field]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const Surface surface = level_surface(8, 4, boundary);
  Map values = numbered(8, 4);
  values(1, 1) = kMissing;
  for (const int row : {2, 3}) values(row, 2) = values(row, 3) = kMissing;
  FieldPyramid pyramid(surface, 2, 2);
  pyramid.fill(values);
  CHECK(at(pyramid, 1, 0, 0) == Approx(11.0 / 3));  // of 0, 1, 10: rounding
  CHECK(at(pyramid, 0, 1, 1) == at(pyramid, 1, 0, 0));
  CHECK(at(pyramid, 2, 0, 0) == Approx((11.0 / 3 + 7.5 + 25.5) / 3));
  CHECK(at(pyramid, 1, 1, 1) == at(pyramid, 2, 0, 0));
  for (const int row : {2, 3}) {
    for (const int column : {2, 3}) CHECK(at(pyramid, 0, row, column) == at(pyramid, 2, 0, 0));
  }
  CHECK(at(pyramid, 0, 1, 2) == 12);  // what is there stays
}

TEST_CASE("a field that is the same everywhere is the same in holes of any size", "[visibility][field]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const auto [width, height] = GENERATE(std::pair{9, 8}, std::pair{13, 3}, std::pair{8, 8});
  const Surface surface = level_surface(width, height, boundary);
  Map values(width, height, 0.7F);
  for (int row = 0; row < height; ++row) {
    for (int column = 2; column < 8; ++column) values(row, column) = kMissing;
  }
  values(2, 0) = kMissing;
  const int levels = levels_to_one(width, height);
  FieldPyramid pyramid(surface, levels, 3);
  pyramid.fill(values);
  REQUIRE((pyramid.level(levels).width == 1 && pyramid.level(levels).height == 1));
  for (int l = 0; l <= levels; ++l) {
    for (int row = -3; row < pyramid.level(l).height + 3; ++row) {
      for (int column = -3; column < pyramid.level(l).width + 3; ++column)
        REQUIRE(at(pyramid, l, row, column) == Approx(0.7F).epsilon(1e-6));  // rounding of means
    }
  }
}

TEST_CASE("a field of nothing but missing samples is finite", "[visibility][field]") {
  const Surface surface = level_surface(3, 2, Boundary::open);
  FieldPyramid pyramid(surface, 1, 1);
  pyramid.fill(Map(3, 2, kMissing));
  for (int l = 0; l <= 1; ++l) {
    for (const float value : pyramid.level(l).values) REQUIRE(std::isfinite(value));
  }
}

TEST_CASE("filled once more, a field has nothing left of what it was", "[visibility][field]") {
  const Surface surface = level_surface(5, 3, Boundary::tile);
  Map values = numbered(5, 3);
  FieldPyramid fresh(surface, 2, 3);
  fresh.fill(values);
  FieldPyramid reused(surface, 2, 3);
  values(1, 1) = kMissing;
  reused.fill(values);
  reused.fill(numbered(5, 3));
  for (int l = 0; l <= 2; ++l) CHECK(reused.level(l).values == fresh.level(l).values);
}

TEST_CASE("beyond an open map, and where samples are missing, there are no heights", "[visibility][field]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const Surface surface = level_surface(4, 2, boundary);
  Map heights = numbered(4, 2);
  heights(1, 2) = kMissing;
  FieldPyramid pyramid(surface, 1, 2);
  pyramid.fill_heights(0, heights);
  CHECK(at(pyramid, 0, 1, 3) == 13);
  CHECK(at(pyramid, 0, 1, 2) == kNoHeight);
  const bool tiles = boundary == Boundary::tile;
  CHECK(at(pyramid, 0, 0, -1) == (tiles ? 3 : kNoHeight));
  CHECK(at(pyramid, 0, 0, 5) == (tiles ? 1 : kNoHeight));
  CHECK(at(pyramid, 0, -1, 0) == (tiles ? 10 : kNoHeight));
  CHECK(at(pyramid, 0, 3, -2) == kNoHeight);  // the missing one, or nothing
  pyramid.fill_heights(1, Map(2, 1, 7));
  CHECK(at(pyramid, 1, 0, 1) == 7);
  CHECK(at(pyramid, 1, 0, 2) == (tiles ? 7 : kNoHeight));
  CHECK(at(pyramid, 1, 1, 0) == (tiles ? 7 : kNoHeight));
}

TEST_CASE("the bytes of a field's levels are those that are told", "[visibility][field]") {
  const Surface surface = level_surface(13, 6, Boundary::tile);
  const FieldPyramid pyramid(surface, 3, 5);
  std::size_t bytes = 0;
  for (int l = 0; l <= 3; ++l) bytes += pyramid.level(l).values.size() * sizeof(float);
  CHECK(bytes == field_pyramid_bytes(13, 6, 3, 5));
}

}  // namespace
}  // namespace heightlight
