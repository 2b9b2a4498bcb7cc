#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "heightlight/error.h"
#include "heightlight/heightmap.h"
#include "test_maps.h"

namespace heightlight {

TEST_CASE("a shrunk map holds the means of its squares, above its lowest", "[heightmap]") {
  Heightmap map = make_map(6, 4, Boundary::tile, [](int row, int column) { return 10 * row + column + 3; });
  map.base = 100;
  map.spacing = {2, 3};
  const Heightmap half = shrink(map, 2);
  REQUIRE(half.height.width == 3);
  REQUIRE(half.height.height == 2);
  CHECK(half.spacing.x == 4);
  CHECK(half.spacing.y == 6);
  CHECK(half.boundary == Boundary::tile);
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 3; ++column) {
      const double mean = 100 + 3 + 10 * (2 * row + 0.5) + 2 * column + 0.5;
      CHECK(half.base + double{half.height(row, column)} ==
            Approx(mean).epsilon(1e-7));  // identity, in floats
    }
  }
  CHECK(half.height(0, 0) == 0);
  CHECK(shrink(map, 1).base + double{shrink(map, 1).height(3, 5)} == Approx(138));
}

TEST_CASE("a curved map that is shrunk is curved about the same place", "[heightmap]") {
  Heightmap map = make_map(12, 6, Boundary::open, [](int, int) { return 0.0; });
  map.spacing = {1000, 2000};
  const Heightmap curved = curve_heights(map);
  const Heightmap found = shrink(curved, 3);
  const Heightmap expected = curve_heights(shrink(map, 3));
  CHECK(found.curved_about_row == Approx(expected.curved_about_row));
  CHECK(found.curved_about_column == Approx(expected.curved_about_column));
  CHECK(level_gradient(found, 0, 3).x == Approx(level_gradient(expected, 0, 3).x));
  CHECK(level_gradient(found, 0, 3).y == Approx(level_gradient(expected, 0, 3).y));
}

TEST_CASE("missing samples are left out of the means, and stay where nothing else is", "[heightmap]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Heightmap map = make_map(4, 2, Boundary::open, [nan](int row, int column) {
    return column >= 2 || (row == 0 && column == 0) ? nan : 1.0 + row + column;
  });
  const Heightmap half = shrink(map, 2);
  CHECK(half.base + double{half.height(0, 0)} == Approx((2.0 + 2 + 3) / 3));
  CHECK(std::isnan(half.height(0, 1)));
}

TEST_CASE("a factor that does not divide a map is refused", "[heightmap]") {
  const Heightmap map = make_map(6, 4, Boundary::tile, [](int, int) { return 0; });
  for (const int factor : {-1, 0, 3, 4, 7}) {
    CAPTURE(factor);
    CHECK_THROWS_AS(shrink(map, factor), UsageError);
  }
}

}  // namespace heightlight
