#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "test_maps.h"
#include "visibility/ray_caster.h"

namespace heightlight {
namespace {

struct TracedRays {
  std::vector<std::int32_t> cell;
  std::vector<float> across, down;
};

using Traverse = void (*)(const RayGrid&, const RayBundle&, const RayEnds&);

TracedRays trace(Traverse traverse_rays, const RayGrid& grid, const RayBundle& bundle) {
  const auto n = static_cast<std::size_t>(bundle.count + kRayPadding);
  TracedRays rays{std::vector<std::int32_t>(n, -7), std::vector<float>(n), std::vector<float>(n)};
  traverse_rays(grid, bundle, {rays.cell.data(), rays.across.data(), rays.down.data()});
  return rays;
}

/// Way to the first facet hit, by testing every facet of the mesh in double precision: the answer that the
/// traversal must find. The facets at the receiver itself are left out.
std::optional<double> brute_force_way(const Surface& surface, int row, int column, double step_u,
                                      double step_v, double slope) {
  const Image<float>& h = surface.map.height;
  std::optional<double> nearest;
  for (int i = 0; i < surface.cell_rows(); ++i) {
    for (int j = 0; j < surface.cell_columns(); ++j) {
      for (int triangle = 0; triangle < 2; ++triangle) {
        const std::array<std::array<int, 2>, 3> vertex{
            {{i, j}, {i + (triangle == 1), j + (triangle == 0)}, {i + 1, j + 1}}};
        std::array<Eigen::Vector3d, 3> p;
        bool at_receiver = false;
        for (std::size_t k = 0; k < 3; ++k) {
          p[k] = {double(vertex[k][1] - column), double(vertex[k][0] - row),
                  double{h(vertex[k][0], vertex[k][1])} - double{h(row, column)}};
          at_receiver = at_receiver || p[k].norm() == 0;
        }
        if (at_receiver || p[0].hasNaN() || p[1].hasNaN() || p[2].hasNaN()) continue;
        // s d = p0 + b e1 + c e2, by Cramer's rule.
        Eigen::Matrix3d system;
        system.col(0) = Eigen::Vector3d(step_u, step_v, slope);
        system.col(1) = p[0] - p[1];
        system.col(2) = p[0] - p[2];
        const Eigen::Vector3d solved = system.partialPivLu().solve(p[0]);
        const bool inside = solved[1] >= 0 && solved[2] >= 0 && solved[1] + solved[2] <= 1 && solved[0] > 0;
        if (inside && (!nearest || solved[0] < *nearest)) nearest = solved[0];
      }
    }
  }
  return nearest;
}

bool is_middle_of_facet(const SurfacePoint& place) {
  return (place.across == kTwoThirds && place.down == kOneThird) ||
         (place.across == kOneThird && place.down == kTwoThirds);
}

TEST_CASE("the lanes and the scalar twin agree bit for bit", "[visibility]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const auto [width, height] =
      GENERATE(std::pair{31, 17}, std::pair{64, 64}, std::pair{1, 9}, std::pair{9, 2}, std::pair{2, 1});
  const double relief = GENERATE(0.01, 0.3, 20.0);
  const double missing = GENERATE(0.0, 0.3);
  const Surface surface = build_surface(make_rough_map(width, height, boundary, relief, missing, 3));
  const RayCaster caster(surface, {.rays = 61, .seed = 1});
  if (surface.cell_columns() == 0 || surface.cell_rows() == 0) return;
  RayWorkspace workspace(caster.rays());
  for (int row = 0; row < height; row += 3) {
    for (int column = 0; column < width; column += 5) {
      if (std::isnan(surface.map.height(row, column))) continue;
      const RayBundle bundle = caster.aim(row, column, caster.directions().turn(row, column), workspace);
      const TracedRays lanes = trace(traverse, caster.grid(), bundle);
      const TracedRays twin = trace(traverse_scalar, caster.grid(), bundle);
      for (std::size_t k = 0; k < static_cast<std::size_t>(bundle.count); ++k) {
        REQUIRE(lanes.cell[k] == twin.cell[k]);
        if (lanes.cell[k] == kSky) continue;
        REQUIRE(lanes.across[k] == twin.across[k]);
        REQUIRE(lanes.down[k] == twin.down[k]);
      }
    }
  }
}

TEST_CASE("sparing rays the walk changes none of their ends", "[visibility]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const int size =
      GENERATE(64, 48, 37);  // blocks of the pyramid that fit a tile at all levels, at some, at none
  const char* shape = GENERATE("fbm", "brick", "steps");
  const Surface surface = build_surface(make_synth_map(shape, size, boundary, 0.2));
  const RayCaster caster(surface, {.rays = 200, .seed = 1});
  RayWorkspace workspace(caster.rays());
  int spared = 0;
  for (int texel = 0; texel < size * size; texel += 7) {
    const int row = texel / size;
    const int column = texel % size;
    RayBundle bundle = caster.aim(row, column, caster.directions().turn(row, column), workspace);
    const TracedRays with = trace(traverse, caster.grid(), bundle);
    spared += static_cast<int>(std::count(bundle.sky_way, bundle.sky_way + bundle.count, 0.0F));
    // Without bounds: the sky is reached above the highest point only.
    for (std::size_t k = 0; k < static_cast<std::size_t>(bundle.count); ++k) {
      const float above = surface.highest - bundle.height;
      workspace.sky_way[k] =
          bundle.slope[k] > 0 ? above / bundle.slope[k] : std::numeric_limits<float>::infinity();
    }
    const TracedRays without = trace(traverse, caster.grid(), bundle);
    for (std::size_t k = 0; k < static_cast<std::size_t>(bundle.count); ++k) {
      REQUIRE(with.cell[k] == without.cell[k]);
      if (with.cell[k] == kSky) continue;
      REQUIRE(with.across[k] == without.across[k]);
      REQUIRE(with.down[k] == without.down[k]);
    }
  }
  CHECK(spared > size * size / 7 * 10);
}

TEST_CASE("a ray ends where testing every facet says", "[visibility]") {
  const double relief = GENERATE(0.05, 0.5);
  const Surface surface = build_surface(make_rough_map(14, 11, Boundary::open, relief, 0, 8));
  const RayCaster caster(surface, {.rays = 127, .seed = 1});
  RayWorkspace workspace(caster.rays());
  int compared = 0;
  for (int row = 1; row < 10; row += 2) {
    for (int column = 1; column < 13; column += 3) {
      const RayBundle bundle = caster.aim(row, column, caster.directions().turn(row, column), workspace);
      const TracedRays rays = trace(traverse, caster.grid(), bundle);
      for (int k = 0; k < bundle.count; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const double u = rays.cell[i] % 14 + double{rays.across[i]} - column;
        const double v = rays.cell[i] / 14 + double{rays.down[i]} - row;
        const bool hit = rays.cell[i] != kSky;
        const SurfacePoint place{0, rays.across[i], rays.down[i]};
        if (hit && is_middle_of_facet(place)) continue;  // the receiver's own facet rises above the ray
        const auto way =
            brute_force_way(surface, row, column, bundle.step_u[k], bundle.step_v[k], bundle.slope[k]);
        REQUIRE(hit == way.has_value());
        // Float rounding of heights near 0.5 against slopes of up to relief per texel.
        if (hit) CHECK(std::hypot(u, v) == Approx(*way).margin(2e-4));
        ++compared;
      }
    }
  }
  CHECK(compared > 1000);
}

TEST_CASE("a ray below its own facet sees that facet's middle", "[visibility]") {
  // In a valley ever steeper to the right, the smooth normal leans less than the facet on the right: it hides
  // some sky.
  const Surface surface =
      build_surface(make_map(8, 8, Boundary::open, [](int, int column) { return column * column; }));
  const RayCaster caster(surface, {.rays = 1024, .seed = 1});
  RayWorkspace workspace(caster.rays());
  ReceiverView view;
  caster.view(4, 3, workspace, view);
  const auto own = std::count_if(view.place.begin(), view.place.end(), is_middle_of_facet);
  CHECK(own > 0);
  for (const SurfacePoint& place : view.place) {
    if (is_middle_of_facet(place)) CHECK(std::abs(static_cast<int>(place.cell % 8) - 3) <= 1);
  }
}

TEST_CASE("holes occlude nothing, and their edges stop rays from below", "[visibility]") {
  // A plateau at 1 with a pit whose walls are missing: the floor sees the plateau's edge, not below it.
  const Surface surface = build_surface(make_map(9, 9, Boundary::open, [](int row, int column) {
    const int from_centre = std::max(std::abs(row - 4), std::abs(column - 4));
    return from_centre == 0 ? 0.0 : from_centre == 1 ? std::nan("") : 1.0;
  }));
  const RayCaster caster(surface, {.rays = 4096, .seed = 1});
  RayWorkspace workspace(caster.rays());
  ReceiverView view;
  caster.view(4, 4, workspace, view);
  const double rim =
      std::atan2(1.0, 2.0 / 9);  // elevation of the rim's nearest points: edges two texels away
  const double sky = sky_share(view).sky_view_factor;
  CHECK(sky < std::cos(rim) * std::cos(rim) * 1.27 +
                  1e-3);  // a square opening is at most 4/π of its inscribed disc
  CHECK(sky > std::cos(rim) * std::cos(rim) - 1e-3);
}

TEST_CASE("a map of holes but for one sample sees only sky", "[visibility]") {
  Heightmap map = make_map(5, 5, Boundary::tile, [](int, int) { return std::nan(""); });
  map.height(2, 3) = 0.5F;
  const Surface surface = build_surface(map);
  const RayCaster caster(surface, {.rays = 64, .seed = 1});
  RayWorkspace workspace(caster.rays());
  ReceiverView view;
  caster.view(2, 3, workspace, view);
  CHECK(view.ray.empty());
  CHECK(sky_share(view).sky_view_factor == 1);
  caster.view(0, 0, workspace, view);
  CHECK(view.rays == 0);
}

}  // namespace
}  // namespace heightlight
