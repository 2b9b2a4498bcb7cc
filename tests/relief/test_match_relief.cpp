#include <catch2/catch.hpp>
#include <cmath>

#include "heightlight/error.h"
#include "heightlight/solve.h"
#include "relief/match_relief.h"
#include "test_maps.h"

namespace heightlight {
namespace {

/// The map with its heights times a factor.
Heightmap scaled(Heightmap map, float factor) {
  for (float& height : map.height.values) height *= factor;
  return map;
}

Map occlusion_of(const Heightmap& map) {
  return solve(build_surface(map), {.wanted = {.sky = true}}).sky_view_factor;
}

TEST_CASE("normals give the relief that they are of, whatever way their y points and on another grid",
          "[relief]") {
  Heightmap map = make_synth_map("fbm", 96, Boundary::tile, 0.1);
  map.height(5, 6) = std::nanf("");
  Image<Vector3> normals = build_surface(scaled(map, 0.3F)).normal;
  const ReliefMatch match = match_normals(map, normals);
  CHECK(match.relief == Approx(0.03).epsilon(1e-5));
  CHECK(match.residual < 0.01);
  CHECK(match.correlation > 0.9999);
  CHECK_FALSE(match.y_down);
  CHECK(match.doubt.empty());
  for (Vector3& normal : normals.values) normal.y = -normal.y;
  const ReliefMatch down = match_normals(map, normals);
  CHECK(down.relief == Approx(0.03).epsilon(1e-5));
  CHECK(down.y_down);
  const Heightmap waves = make_synth_map("sines", 192, Boundary::tile, 0.1);
  const ReliefMatch coarse = match_normals(waves, build_surface(shrink(scaled(waves, 0.3F), 2)).normal);
  CHECK(coarse.relief == Approx(0.03).epsilon(0.1));  // discretisation: slopes of means are gentler
}

TEST_CASE("occlusion gives the relief that it is of", "[relief]") {
  const Heightmap map = make_synth_map("cobbles", 64, Boundary::tile, 0.1);
  const float factor = GENERATE(0.2F, 1.7F);
  const ReliefMatch match = match_occlusion(map, occlusion_of(scaled(map, factor)));
  CHECK(match.relief == Approx(0.1 * double{factor}).epsilon(0.04));  // the search ends at 2 %
  CHECK(match.residual < 0.01);
  CHECK(match.correlation > 0.99);
  CHECK(match.doubt.empty());
}

TEST_CASE("the middle of a large map is enough", "[relief]") {
  const int side = kMatchSide + 64;
  const Heightmap map = make_synth_map("fbm", side, Boundary::tile, 0.02);
  const ReliefMatch match = match_occlusion(map, occlusion_of(map));
  CHECK(match.relief == Approx(0.02).epsilon(0.04));
}

TEST_CASE("what fits no relief is doubted or refused", "[relief]") {
  const Heightmap map = make_synth_map("fbm", 64, Boundary::tile, 0.1);
  const Heightmap other = make_synth_map("brick", 64, Boundary::tile, 0.1);
  CHECK_FALSE(match_occlusion(map, occlusion_of(other)).doubt.empty());
  CHECK_FALSE(match_occlusion(map, Map(64, 64, 1.0F)).doubt.empty());  // open: the lowest that was tried
  Heightmap depths = map;
  for (float& height : depths.height.values) height = -height;
  CHECK_THROWS_WITH(match_normals(depths, build_surface(map).normal), Catch::Contains("the other way"));
  CHECK_THROWS_AS(match_normals(scaled(map, 0), build_surface(map).normal), UsageError);
}

}  // namespace
}  // namespace heightlight
