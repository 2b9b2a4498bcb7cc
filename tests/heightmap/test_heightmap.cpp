#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "files/level_count.h"
#include "heightlight/files.h"

using namespace heightlight;

namespace {

const float kMissing = std::numeric_limits<float>::quiet_NaN();

Image<float> waves(int columns, int rows, double periods) {
  Image<float> height(columns, rows);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      height(row, column) = static_cast<float>(std::sin(2 * std::numbers::pi * periods * column / columns) +
                                               std::cos(2 * std::numbers::pi * periods * row / rows));
    }
  }
  return height;
}

}  // namespace

TEST_CASE("Relief and missing samples leave NaN out", "[heightmap]") {
  Heightmap map;
  map.height = Image<float>(3, 1);
  map.height.values = {kMissing, 1, 4};
  CHECK(relief(map) == 3);
  CHECK(count_missing(map) == 1);
  map.height.values = {kMissing, kMissing, kMissing};
  CHECK(relief(map) == 0);
  CHECK(count_missing(map) == 3);
}

TEST_CASE("Boundaries have names", "[heightmap]") {
  CHECK(to_string(Boundary::tile) == std::string("tile"));
  CHECK(to_string(Boundary::open) == std::string("open"));
}

TEST_CASE("Whole waves wrap, half a wave more does not", "[heightmap]") {
  CHECK(measure_edge_steps(waves(64, 32, 2)).wraps);
  CHECK_FALSE(measure_edge_steps(waves(64, 32, 2.5)).wraps);
}

TEST_CASE("A ramp wraps along its contours only", "[heightmap]") {
  Image<float> ramp(4, 3);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) ramp(row, column) = static_cast<float>(2 * column);
  }
  const EdgeSteps steps = measure_edge_steps(ramp);
  CHECK(steps.across_x == 6);
  CHECK(steps.inside_x == 2);
  CHECK(steps.across_y == 0);
  CHECK(steps.inside_y == 0);
  CHECK_FALSE(steps.wraps);
}

TEST_CASE("Edge steps leave missing samples out, and say NaN where nothing is left", "[heightmap]") {
  Image<float> height(3, 2);
  height.values = {0, 1, 2, kMissing, 1, 2};
  CHECK(measure_edge_steps(height).across_x == 2);
  const EdgeSteps steps = measure_edge_steps(Image<float>(1, 2));
  CHECK(std::isnan(steps.across_x));
  CHECK(std::isnan(steps.inside_x));
  CHECK(steps.wraps);
}

TEST_CASE("Levels are counted once each, NaN never, and 0 is −0", "[heightmap]") {
  Image<double> values(6, 1);
  values.values = {0.0, -0.0, 1.5, 1.5, std::numeric_limits<double>::quiet_NaN(), -3};
  CHECK(count_levels(values).count == 3);
  CHECK(count_levels(values).step == 2.25);  // of -3, 0, 1.5: 3 and 1.5
}

TEST_CASE("Levels are counted up to what 16 bits can tell apart", "[heightmap]") {
  Image<double> values(300, 300);
  for (std::size_t i = 0; i < values.size(); ++i) values.values[i] = static_cast<double>(i % kMostLevels);
  CHECK(count_levels(values).count == kMostLevels);
  for (std::size_t i = 0; i < values.size(); ++i) values.values[i] = static_cast<double>(i);
  CHECK(count_levels(values).count == kMostLevels + 1);
}
