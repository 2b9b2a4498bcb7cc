#include <catch2/catch.hpp>
#include <cmath>

#include "base/texel_algebra.h"
#include "heightlight/surface.h"
#include "surface/maximum_pyramid.h"
#include "test_maps.h"

namespace heightlight {
namespace {

constexpr double kRounding = 1e-6;  // a few float roundings of numbers near 1

TEST_CASE("a plane has its own normal everywhere, open edges included", "[surface]") {
  Heightmap map =
      make_map(7, 5, Boundary::open, [](int row, int column) { return 0.3 * column - 0.2 * row; });
  map.spacing = {2, 0.5};
  const Surface surface = build_surface(map);
  // Rows run down the image and y up: the height grows by 0.2 per row upwards.
  const Eigen::Vector3d expected = Eigen::Vector3d(-0.3 / 2, -0.2 / 0.5, 1).normalized();
  for (const Vector3& normal : surface.normal.values) {
    CHECK((as_eigen(normal).cast<double>() - expected).norm() < kRounding);
  }
}

TEST_CASE("normals wrap when tiling", "[surface]") {
  const Heightmap map =
      make_map(4, 1, Boundary::tile, [](int, int column) { return column == 0 ? 1.0 : 0.0; });
  const Surface surface = build_surface(map);
  const double slope = 1.0 / (2 * 0.25);
  CHECK(surface.normal(0, 0).z == 1.0F);                                   // both neighbours alike
  CHECK(surface.normal(0, 3).x == Approx(-slope / std::hypot(1, slope)));  // the peak is its right neighbour
  CHECK(surface.normal(0, 1).x == Approx(slope / std::hypot(1, slope)));
}

TEST_CASE("beside a missing sample the slope is one-sided, and a lone sample is level", "[surface]") {
  const float hole = std::nanf("");
  Heightmap map = make_map(3, 1, Boundary::open, [](int, int column) { return 0.5 * column; });
  map.spacing = {1, 1};
  map.height(0, 2) = hole;
  Surface surface = build_surface(map);
  CHECK(surface.normal(0, 1).x == Approx(-0.5 / std::hypot(1, 0.5)));
  CHECK(std::isnan(surface.normal(0, 2).z));
  map.height(0, 0) = hole;
  surface = build_surface(map);
  CHECK(surface.normal(0, 1) == Vector3{0, 0, 1});
}

TEST_CASE("each entry of the maximum pyramid is the highest vertex of its block", "[surface]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const Surface surface = build_surface(make_rough_map(13, 6, boundary, 1, 0.2, 5));
  const MaximumPyramid pyramid = build_maximum_pyramid(surface);
  const Image<float>& h = surface.map.height;
  REQUIRE(pyramid.levels == 5);  // 13 cells need blocks of up to 16
  for (int level = 0; level < pyramid.levels; ++level) {
    for (int row = 0; row < surface.cell_rows(); ++row) {
      for (int column = 0; column < surface.cell_columns(); ++column) {
        float expected = -std::numeric_limits<float>::infinity();
        for (int i = 0; i < surface.cell_rows(); ++i) {
          for (int j = 0; j < surface.cell_columns(); ++j) {
            if (i >> level != row >> level || j >> level != column >> level) continue;
            for (int corner = 0; corner < 4; ++corner) {
              const float vertex = h((i + corner / 2) % h.height, (j + corner % 2) % h.width);
              if (vertex > expected) expected = vertex;
            }
          }
        }
        CHECK(pyramid.highest[static_cast<std::size_t>(pyramid.index(level, row, column))] == expected);
      }
    }
  }
}

}  // namespace
}  // namespace heightlight
