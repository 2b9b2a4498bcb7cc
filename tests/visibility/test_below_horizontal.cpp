// A sky that has nothing below the horizontal: A of a plane tilted by S is (1 + cos S)/2, and α 1 − S/π, the
// shares of its hemisphere that lie above.

#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "heightlight/error.h"
#include "heightlight/solve.h"
#include "visibility/walked_tiles.h"

namespace heightlight {
namespace {

/// Rises by tan S along an azimuth that is no axis.
Surface tilted_plane(int size, double tilt) {
  return build_surface(make_map(size, size, Boundary::open, [&](int row, int column) {
    return std::tan(tilt) * (0.8 * column - 0.6 * row) / size;
  }));
}

Request sky_of_ground(Visibility visibility) {
  Request request;
  request.wanted = {.sky = true, .below = BelowHorizontal::ground};
  request.accuracy = {.visibility = visibility, .error = 0.001, .azimuths = 0, .rays = 16384};
  if (visibility == Visibility::exact_slices) request.accuracy.azimuths = 256;
  return request;
}

double largest_error(const Map& map, double expected) {
  double worst = 0;
  for (const float value : map.values) worst = std::max(worst, std::fabs(double{value} - expected));
  return worst;
}

TEST_CASE("a tilted plane sees the sky above the horizontal only, by every method", "[visibility][below]") {
  const double tilt = GENERATE(0.0, 0.2, std::numbers::pi / 4, 1.2);
  // Of A, and of α, for which walks do not aim.
  const auto [visibility, tolerance, uniform] = GENERATE(table<Visibility, double, double>({
      {Visibility::exact_slices, 1e-4, 2e-4},   // discretisation: 256 azimuths
      {Visibility::horizon_walks, 2e-3, 3e-2},  // discretisation: twice the error wanted, at any texel
      {Visibility::rays, 4e-3, 8e-3},           // Monte Carlo: 16384 stratified rays
  }));
  const Surface surface = tilted_plane(visibility == Visibility::horizon_walks ? 48 : 12, tilt);
  const Results results = solve(surface, sky_of_ground(visibility));
  INFO("tilt " << tilt << ", method " << static_cast<int>(visibility));
  CHECK(largest_error(results.sky_view_factor, (1 + std::cos(tilt)) / 2) < tolerance);
  CHECK(largest_error(results.ambient_occlusion, 1 - tilt / std::numbers::pi) < uniform);
  if (visibility == Visibility::horizon_walks) {
    REQUIRE(results.evidence.sky_rmse);
    CHECK(*results.evidence.sky_rmse < 1.15e-3);
  }
}

TEST_CASE("a reach does not let light up from below the horizontal", "[visibility][below]") {
  const Falloff falloff = GENERATE(Falloff::none, Falloff::linear);
  const Visibility visibility = GENERATE(Visibility::exact_slices, Visibility::horizon_walks);
  Request request = sky_of_ground(visibility);
  request.wanted.maximum_distance = MaximumDistance{.distance = 0.2, .falloff = falloff};
  const Results results = solve(tilted_plane(24, 0.7), request);
  CHECK(largest_error(results.sky_view_factor, (1 + std::cos(0.7)) / 2) < 2e-3);  // discretisation
}

TEST_CASE("the ground's sky walk and its scalar twin agree on every instruction set",
          "[visibility][below][walk]") {
  const auto holes = GENERATE(0.0, 0.3);
  Heightmap map = make_rough_map(70, 53, Boundary::open, 0.3, holes, 4);
  map.curvature = 0.2;  // of some heights: what is level tilts by up to 0.15
  const Surface surface = build_surface(std::move(map));
  const WalkOptions options{.azimuths = 6, .samples_per_octave = 16, .peak_share = 0.3F};
  const auto walk_with = [&](WalkSky walk) {
    std::vector<float> sums;
    for_tiles(surface, options, [&](const WalkTile& tile) {
      const auto sky = std::make_unique<SkySums>();
      const auto far = std::make_unique<FarView>();
      sky->below = BelowHorizontal::ground;
      for (int k = 0; k < options.azimuths; ++k) {
        const AzimuthTable azimuth = make_azimuth_table(surface, options, azimuth_rad(options, k));
        look_far_scalar(tile, azimuth, *far);
        walk(tile, azimuth, *far, *sky);
      }
      for_present(tile, [&](std::size_t at, int, int) {
        sums.push_back(sky->sky[at]);
        sums.push_back(sky->solid[at]);
      });
    });
    return sums;
  };
  const std::vector<float> twin = walk_with(walk_sky_scalar);
  for (const std::int64_t target : instruction_sets()) {
    const InstructionSet use(target);
    const std::vector<float> lanes = walk_with(walk_sky);
    REQUIRE(lanes.size() == twin.size());
    double worst = 0;
    for (std::size_t i = 0; i < twin.size(); ++i)
      worst = std::max(worst, std::fabs(double{lanes[i]} - double{twin[i]}) / options.azimuths);
    CHECK(worst < 1e-6);  // identity: fused products, and the arc tangent
  }
}

TEST_CASE("moments leave out what is below the horizontal", "[visibility][below]") {
  Request request = sky_of_ground(Visibility::horizon_walks);
  request.wanted.moments = {.first = true, .second = true};
  const Results results = solve(build_surface(make_synth_map("fbm", 96, Boundary::open, 0.3)), request);
  REQUIRE(results.evidence.sky_check);
  // Discretisation: at an error of 0.002 bent normals err by up to 0.4 degrees; see kMomentShare.
  CHECK(*results.evidence.sky_check->bent_normal_rad < 0.4 * std::numbers::pi / 180);
  CHECK(*results.evidence.sky_check->harmonics < 1e-3);
}

TEST_CASE("totals are lit from above the horizontal, and carried on as ever", "[visibility][below][solve]") {
  const Surface surface = build_surface(make_synth_map("fbm", 64, Boundary::open, 0.4));
  Request request = sky_of_ground(Visibility::horizon_walks);
  request.wanted.totals = {{.constant = {0.5}}, {.constant = {0.8}}};
  request.accuracy.error = 0.002;
  const Results walked = solve(surface, request);

  // Identity: the same as light of one's own.
  Request given = request;
  given.wanted = {.totals = request.wanted.totals};
  TexelVector& direct = given.wanted.direct.emplace_back();
  for (const float share : walked.sky_view_factor.values) direct.push_back(double{share});
  CHECK(solve(surface, given).totals == walked.totals);

  request.accuracy = {.visibility = Visibility::exact_slices, .azimuths = 128};
  const Results exact = solve(surface, request);
  for (std::size_t t = 0; t < 2; ++t) {
    double squares = 0;
    double below = 0;
    const TexelVector& total = exact.totals[t][0];
    for (std::size_t i = 0; i < total.size(); ++i) {
      squares += (walked.totals[t][0][i] - total[i]) * (walked.totals[t][0][i] - total[i]);
      below = std::max(below, total[i]);
    }
    CHECK(std::sqrt(squares / static_cast<double>(total.size())) < 1.3 * 0.002);  // discretisation
    CHECK(below < 1);  // a slope gets less than a plane under the whole sky does
    CHECK(walked.evidence.total_checks[t].total_rmse < 1.15 * 0.002);
  }
}

TEST_CASE("single bounces and n refuse a sky without its lower part", "[visibility][below][solve]") {
  const Surface surface = tilted_plane(8, 0.3);
  Request request = sky_of_ground(Visibility::horizon_walks);
  SECTION("n") { request.wanted.seen = true; }
  SECTION("bounces") { request.wanted.bounces = 3; }
  CHECK_THROWS_AS(solve(surface, request), UsageError);
}

}  // namespace
}  // namespace heightlight
