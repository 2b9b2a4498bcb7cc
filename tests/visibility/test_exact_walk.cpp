#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/texel_algebra.h"
#include "test_maps.h"
#include "visibility/exact_walk.h"

namespace heightlight {
namespace {

double row_sum(const SliceView& view) {
  return std::accumulate(view.links.begin(), view.links.end(), view.sky_view_factor,
                         [](double sum, const VisibleInterval& link) { return sum + link.weight; });
}

SliceView view_at(const ExactWalker& walker, int row, int column) {
  SliceView view;
  walker.view(row, column, view);
  return view;
}

TEST_CASE("what the exact walk sees sums to 1 with the sky", "[visibility][exact]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const double missing = GENERATE(0.0, 0.3);
  const double relief = GENERATE(0.02, 0.5, 1000.0);
  const auto [width, height] =
      GENERATE(std::pair{24, 19}, std::pair{1, 9}, std::pair{9, 2}, std::pair{2, 1}, std::pair{1, 1});
  const int azimuths = GENERATE(1, 7, 64);
  const Surface surface = build_surface(make_rough_map(width, height, boundary, relief, missing, 4));
  const ExactWalker walker(surface, azimuths);
  SliceView view;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      walker.view(row, column, view);
      if (std::isnan(surface.map.height(row, column))) {
        CHECK(std::isnan(view.sky_view_factor));
        CHECK(std::isnan(view.ambient_occlusion));
        CHECK(view.links.empty());
        continue;
      }
      CHECK(std::fabs(row_sum(view) - 1) < 1e-13);  // identity: √n·ε of some hundred links
      CHECK(view.sky_view_factor > 0);
      CHECK(view.ambient_occlusion > 0);
      CHECK(view.ambient_occlusion <= 1);
      CHECK(view.bent_normal.norm() == Approx(1).epsilon(1e-14));
      for (const VisibleInterval& link : view.links) {
        CHECK(link.weight >= -1e-17);  // a hair above the tangent plane the cosine is rounding
        CHECK(link.place.cell < surface.map.height.size());
      }
    }
  }
}

TEST_CASE("the exact walk finds a flat map open to the last bit", "[visibility][exact]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const Surface flat = build_surface(make_map(9, 6, boundary, [](int, int) { return 0.7; }));
  const ExactWalker walker(flat, 12);
  for (int texel = 0; texel < 9 * 6; ++texel) {
    const SliceView view = view_at(walker, texel / 9, texel % 9);
    CHECK(view.sky_view_factor == 1);
    CHECK(view.ambient_occlusion == 1);
    CHECK(view.links.empty());
    CHECK((view.bent_normal - Eigen::Vector3d::UnitZ()).norm() < 1e-15);
  }
}

TEST_CASE("the exact walk finds an open tilted plane open, also below the horizontal",
          "[visibility][exact]") {
  const Surface plane = build_surface(
      make_map(16, 11, Boundary::open, [](int row, int column) { return 0.25 * column + 0.125 * row; }));
  const ExactWalker walker(plane, 64);
  for (int texel = 0; texel < 16 * 11; ++texel) {
    const SliceView view = view_at(walker, texel / 16, texel % 16);
    // The normal is a float: it leans by up to 10⁻⁷ over the plane, and the cosine mass goes with the square.
    CHECK(view.sky_view_factor == Approx(1).margin(1e-12));
    CHECK(view.ambient_occlusion == Approx(1).margin(1e-7));
  }
  const SliceView inside = view_at(walker, 5, 8);
  CHECK((inside.bent_normal - as_eigen(plane.normal(5, 8)).cast<double>()).norm() < 1e-6);
  // Seen from the middle, the plane itself is the horizon; at the outer corners there is no surface on one
  // side.
  for (int k = 0; k < 64; ++k) {
    const double azimuth = walker.azimuth_rad(k);
    const double slope = 16 * (0.25 * std::cos(azimuth) - 0.125 * std::sin(azimuth));
    CHECK(inside.horizon_rad[static_cast<std::size_t>(k)] == Approx(std::atan(slope)).margin(1e-12));
  }
  CHECK(walker.horizon_rad(0, 15, std::numbers::pi / 4) == -std::numbers::pi / 2);
}

/// A trench along the rows' direction, floor at columns 24 … 40 of 64 and `depth` (texels) below the rest.
Surface make_trench(double depth) {
  Heightmap map = make_map(64, 8, Boundary::tile,
                           [&](int, int column) { return column >= 24 && column <= 40 ? 0.0 : depth; });
  map.spacing = {1, 3};
  return build_surface(std::move(map));
}

TEST_CASE("horizons in a trench rise to its rims", "[visibility][exact]") {
  constexpr double kDepth = 16;
  const Surface trench = make_trench(kDepth);
  const ExactWalker walker(trench, 512);
  for (int column = 25; column < 40; ++column) {
    const SliceView view = view_at(walker, 3, column);
    for (int k = 0; k < walker.azimuths(); ++k) {
      const double cosine = std::cos(walker.azimuth_rad(k));
      const double distance = cosine > 0 ? 41 - column : column - 23;
      const double expected = std::atan(kDepth * std::fabs(cosine) / distance);
      CHECK(view.horizon_rad[static_cast<std::size_t>(k)] == Approx(expected).margin(1e-12));
    }
  }
  // In the middle both rims are alike, the integrand is smooth in the azimuth, and the quadrature converges
  // faster than any power.
  CHECK(view_at(walker, 3, 32).sky_view_factor == Approx(9 / std::hypot(9.0, kDepth)).margin(1e-12));
  // Elsewhere the second derivative jumps at the trench's own direction: third order, (2π/512)³ of the jump.
  const double off_centre = 0.5 * (3 / std::hypot(3.0, kDepth) + 15 / std::hypot(15.0, kDepth));
  CHECK(view_at(walker, 3, 26).sky_view_factor == Approx(off_centre).margin(1e-5));
}

TEST_CASE("at the foot of a cliff the exact walk loses half of 1 - cos of its elevation",
          "[visibility][exact]") {
  constexpr int kDepth = 8;
  Heightmap map =
      make_map(33, 9, Boundary::open, [&](int, int column) { return column < 20 ? 0.0 : double{kDepth}; });
  map.spacing = {1, 1e6};  // so long that its ends do not show
  const Surface cliff = build_surface(std::move(map));
  const ExactWalker walker(cliff, 512);
  for (int column = 1; column < 19; ++column) {
    const double distance = 20 - column;
    const double cosine = distance / std::hypot(distance, kDepth);
    // discretisation: third order as in the trench
    CHECK(view_at(walker, 4, column).sky_view_factor == Approx(0.5 * (1 + cosine)).margin(1e-5));
    CHECK(walker.horizon_rad(4, column, 0) == Approx(std::atan(kDepth / distance)).margin(1e-15));
  }
  CHECK(view_at(walker, 4, 25).sky_view_factor == 1);
}

TEST_CASE("the exact walk commutes with shifts of a tile, bit for bit", "[visibility][exact]") {
  // 6 azimuths: one of them runs along diagonals, through vertices only.
  const int azimuths = GENERATE(6, 13, 32);
  const auto [width, height] = GENERATE(std::pair{37, 23}, std::pair{32, 16});
  const double missing = GENERATE(0.0, 0.2);
  Heightmap map = make_rough_map(width, height, Boundary::tile, 0.1, missing, 11);
  if (width == 32) map.spacing.y *= 1.7;
  const int down = 5;
  const int right = 11;
  const Surface here = build_surface(map);
  const Surface there = build_surface(shift_map(map, down, right));
  const ExactWalker walker(here, azimuths);
  const ExactWalker shifted_walker(there, azimuths);
  for (int row = 0; row < height; row += 2) {
    for (int column = 0; column < width; column += 3) {
      if (std::isnan(map.height(row, column))) continue;
      const SliceView view = view_at(walker, row, column);
      const SliceView shifted = view_at(shifted_walker, (row + down) % height, (column + right) % width);
      REQUIRE(view.sky_view_factor == shifted.sky_view_factor);
      REQUIRE(view.ambient_occlusion == shifted.ambient_occlusion);
      REQUIRE(view.horizon_rad == shifted.horizon_rad);
      REQUIRE(view.links.size() == shifted.links.size());
      for (std::size_t i = 0; i < view.links.size(); ++i) {
        const SurfacePoint& place = view.links[i].place;
        const SurfacePoint& moved = shifted.links[i].place;
        const int cell_row = static_cast<int>(place.cell) / width;
        const int cell_column = static_cast<int>(place.cell) % width;
        REQUIRE(static_cast<int>(moved.cell) ==
                (cell_row + down) % height * width + (cell_column + right) % width);
        REQUIRE(view.links[i].weight == shifted.links[i].weight);
        REQUIRE(place.across == moved.across);
        REQUIRE(place.down == moved.down);
      }
    }
  }
}

TEST_CASE("nothing beyond the reach counts, and a facet is cut where it ends", "[visibility][exact]") {
  // A ramp of slope 2 from column 10 on.
  Heightmap map =
      make_map(33, 5, Boundary::open, [](int, int column) { return 2.0 * std::max(0, column - 10); });
  map.spacing = {1, 1};
  const Surface ramp = build_surface(std::move(map));
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(ExactWalker(ramp, 4, 8.0).horizon_rad(2, 2, 0) == 0);
  CHECK(std::tan(ExactWalker(ramp, 4, 11.25).horizon_rad(2, 2, 0)) ==
        Approx(2 * 3.25 / 11.25).epsilon(1e-14));
  CHECK(std::tan(ExactWalker(ramp, 4, infinity).horizon_rad(2, 2, 0)) ==
        Approx(2 * 22.0 / 30).epsilon(1e-14));
  const SliceView nothing = view_at(ExactWalker(ramp, 16, 5.0), 2, 2);
  CHECK(nothing.sky_view_factor == 1);
  CHECK(nothing.links.empty());
}

TEST_CASE("azimuths along the outer lines of an open map stay on the map", "[visibility][exact]") {
  Heightmap map =
      make_map(9, 7, Boundary::open, [](int row, int column) { return row * row + column * column; });
  map.spacing = {1, 1};
  const Surface surface = build_surface(std::move(map));
  const ExactWalker walker(surface, 4);
  // Downwards along the right-hand column, to the right along the last row: up to their far ends.
  CHECK(walker.horizon_rad(0, 8, -std::numbers::pi / 2) == Approx(std::atan(6.0)).margin(1e-15));
  CHECK(walker.horizon_rad(0, 0, -std::numbers::pi / 2) == Approx(std::atan(6.0)).margin(1e-15));
  CHECK(walker.horizon_rad(6, 0, 0) == Approx(std::atan(8.0)).margin(1e-15));
  CHECK(walker.horizon_rad(6, 8, std::numbers::pi) == Approx(std::atan(-8.0)).margin(1e-15));
  CHECK(walker.horizon_rad(6, 8, 0) == -std::numbers::pi / 2);
}

}  // namespace
}  // namespace heightlight
