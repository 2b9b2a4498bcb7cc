// What terrain science calls a sky view factor, or openness, against closed forms on planes, pits and domes.
//
// On a plane tilted by S, rising along φ = 0, the horizon toward φ stands at tan h = tan S cos φ, above the
// horizontal in half of all azimuths. Over these the means of cos² h and sin h are cos S and 2 S/π, that of
// cos h is (2/π) cos S K(sin S), K the complete elliptic integral; over the others they are 1, 0 and 1.

#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "heightlight/error.h"
#include "heightlight/solve.h"
#include "shared_data.h"
#include "visibility/horizon_means.h"
#include "visibility/walked_tiles.h"

namespace heightlight {
namespace {

Request request_of(const std::vector<SkyDefinition>& definitions, Visibility visibility,
                   double error = 0.001) {
  Request request;
  request.wanted.definitions = definitions;
  request.accuracy.visibility = visibility;
  request.accuracy.error = error;
  if (visibility == Visibility::exact_slices) request.accuracy.azimuths = 128;
  request.checks.sky = visibility == Visibility::horizon_walks;
  return request;
}

std::vector<SkyDefinition> all_definitions() {
  std::vector<SkyDefinition> all;
  for (const SkyDefinitionFacts& facts : sky_definitions()) all.push_back(facts.definition);
  return all;
}

double value_at(const Results& results, SkyDefinition definition, int row, int column) {
  return double{results.definitions[static_cast<std::size_t>(definition)](row, column)};
}

/// Heights by the distance from the middle sample, texels of 1.
template <class Height>
Surface round_surface(int side, Height&& height_at) {
  Heightmap map = make_map(side, side, Boundary::open, [&](int row, int column) {
    return height_at(std::hypot(row - side / 2, column - side / 2));
  });
  map.spacing = {1, 1};
  return build_surface(std::move(map));
}

TEST_CASE("definitions have their names, and are found by them", "[visibility][definitions]") {
  for (const SkyDefinitionFacts& facts : sky_definitions()) {
    CHECK(sky_definition_named(facts.name) == facts.definition);
    CHECK(facts_of(facts.definition).name == facts.name);
  }
  CHECK_THROWS_AS(sky_definition_named("svf"), UsageError);
}

TEST_CASE("definitions on a tilted plane are closed forms", "[visibility][definitions]") {
  const double tilt = GENERATE(0.0, 0.3, std::numbers::pi / 4, 1.1);
  const auto [visibility, tolerance] = GENERATE(table<Visibility, double>({
      {Visibility::exact_slices, 5e-4},   // discretisation: 128 azimuths
      {Visibility::horizon_walks, 2e-3},  // discretisation: twice the error wanted, at any texel
  }));
  constexpr int kSide = 33;
  const Surface surface = build_surface(make_map(kSide, kSide, Boundary::open, [&](int row, int column) {
    return std::tan(tilt) * (0.8 * column - 0.6 * row) / kSide;
  }));
  Request request = request_of(all_definitions(), visibility);
  request.wanted.below = BelowHorizontal::ground;
  const Results results = solve(surface, request);
  const double elliptic = std::comp_ellint_1(std::sin(tilt));
  const double expected[] = {(1 + std::cos(tilt)) / 2,    (1 + std::cos(tilt)) / 2,
                             1 - tilt / std::numbers::pi, std::numbers::pi / 2,
                             std::numbers::pi / 2,        0.5 + std::cos(tilt) * elliptic / std::numbers::pi,
                             (1 - std::cos(tilt)) / 2};
  for (const SkyDefinitionFacts& facts : sky_definitions()) {
    INFO(facts.name << ", tilt " << tilt << ", method " << static_cast<int>(visibility));
    CHECK(value_at(results, facts.definition, kSide / 2, kSide / 2) ==
          Approx(expected[static_cast<std::size_t>(facts.definition)]).margin(tolerance));
  }
}

TEST_CASE("a level map is open to its corners", "[visibility][definitions]") {
  const Visibility visibility = GENERATE(Visibility::exact_slices, Visibility::horizon_walks);
  const Surface surface = build_surface(make_map(20, 12, Boundary::open, [](int, int) { return 0.25; }));
  const Results results = solve(surface, request_of(all_definitions(), visibility));
  const double expected[] = {1, 1, 1, std::numbers::pi / 2, std::numbers::pi / 2, 1, 0};
  for (const SkyDefinitionFacts& facts : sky_definitions()) {
    INFO(facts.name);
    const Map& map = results.definitions[static_cast<std::size_t>(facts.definition)];
    for (const float value : map.values)
      REQUIRE(double{value} ==
              Approx(expected[static_cast<std::size_t>(facts.definition)]).margin(1e-6));  // identity
  }
}

// A level floor, and from 30 texels on a cone that the horizon stands at, whatever the azimuth: what the
// triangles cut off a circle of that radius is 1/8r² of it. The cone upside down is a dome with a level top.
TEST_CASE("in the middle of a pit all horizons are alike, and a dome is a pit upside down",
          "[visibility][definitions]") {
  const Visibility visibility = GENERATE(Visibility::exact_slices, Visibility::horizon_walks);
  constexpr int kSide = 97;
  constexpr double kBeta = 0.6;
  constexpr double kTolerance = 2e-3;  // discretisation: twice the error wanted
  const auto wall = [&](double r) { return r < 30 ? 0.0 : std::tan(kBeta) * r; };
  const Results pit = solve(round_surface(kSide, wall), request_of(all_definitions(), visibility));
  const Results dome = solve(round_surface(kSide, [&](double r) { return -wall(r); }),
                             request_of(all_definitions(), visibility));
  const int middle = kSide / 2;
  const double s = std::sin(kBeta);
  const double c = std::cos(kBeta);
  const double in_pit[] = {c * c, c * c, 1 - s, std::numbers::pi / 2 - kBeta, std::numbers::pi / 2, c, s * s};
  const double on_dome[] = {1, 1, 1, std::numbers::pi / 2, std::numbers::pi / 2 - kBeta, 1, 0};
  for (const SkyDefinitionFacts& facts : sky_definitions()) {
    INFO(facts.name << ", method " << static_cast<int>(visibility));
    const auto at = static_cast<std::size_t>(facts.definition);
    CHECK(value_at(pit, facts.definition, middle, middle) == Approx(in_pit[at]).margin(kTolerance));
    CHECK(value_at(dome, facts.definition, middle, middle) == Approx(on_dome[at]).margin(kTolerance));
  }
}

TEST_CASE("on a summit the horizon lies below the horizontal, and openness passes a right angle",
          "[visibility][definitions]") {
  // Discretisation. At a tip fast walks are off by what their samples cut off of the nearest texels.
  const auto [visibility, tolerance] = GENERATE(
      table<Visibility, double>({{Visibility::exact_slices, 1e-4}, {Visibility::horizon_walks, 1e-2}}));
  constexpr int kSide = 65;
  constexpr double kSlope = 0.4;
  const Results summit =
      solve(round_surface(kSide, [](double r) { return -std::tan(kSlope) * r; }),
            request_of({SkyDefinition::openness_positive, SkyDefinition::svf_horizontal}, visibility));
  const int middle = kSide / 2;
  CHECK(double{summit.definitions[0](middle, middle)} ==
        Approx(std::numbers::pi / 2 + kSlope).margin(tolerance));
  CHECK(summit.definitions[1](middle, middle) == 1);
}

TEST_CASE("sums of horizons and their scalar twins agree on every instruction set",
          "[visibility][definitions][walk]") {
  const double holes = GENERATE(0.0, 0.3);
  const bool within = GENERATE(false, true);
  Heightmap map = make_rough_map(70, 53, Boundary::open, 0.3, holes, 4);
  map.curvature = 0.2;
  const Surface surface = build_surface(std::move(map));
  const WalkOptions options{.azimuths = 6, .samples_per_octave = 16, .peak_share = 0.3F};
  const auto sums_by = [&](auto&& add, auto&& add_within) {
    std::vector<float> values;
    for_tiles(surface, options, [&](const WalkTile& tile) {
      const auto sums = std::make_unique<HorizonSums>();
      const auto far = std::make_unique<FarView>();
      for (int k = 0; k < options.azimuths; ++k) {
        AzimuthTable azimuth = make_azimuth_table(surface, options, azimuth_rad(options, k));
        if (within) {
          add_within(tile, azimuth, make_distance_table(azimuth, {.distance = 0.2}), *sums);
        } else {
          look_far_scalar(tile, azimuth, *far);
          add(tile, azimuth, *far, *sums);
        }
      }
      for_present(tile, [&](std::size_t at, int, int) {
        for (const auto& mean : sums->of) values.push_back(mean[at] / static_cast<float>(options.azimuths));
      });
    });
    return values;
  };
  const std::vector<float> twin = sums_by(add_horizons_scalar, add_horizons_within_scalar);
  for (const std::int64_t target : instruction_sets()) {
    const InstructionSet use(target);
    const std::vector<float> lanes = sums_by(add_horizons, add_horizons_within);
    REQUIRE(lanes.size() == twin.size());
    double worst = 0;
    for (std::size_t i = 0; i < twin.size(); ++i)
      worst = std::max(worst, std::fabs(double{lanes[i]} - double{twin[i]}));
    CHECK(worst < 1e-6);  // identity: fused products, and the arc tangent
  }
}

/// RMSE of walks against exact slices, per definition; and what the walks say themselves.
void check_promise(const Surface& surface, double error) {
  const Results walked = solve(surface, request_of(all_definitions(), Visibility::horizon_walks, error));
  const Results exact = solve(surface, request_of(all_definitions(), Visibility::exact_slices));
  for (const SkyDefinitionFacts& facts : sky_definitions()) {
    const auto at = static_cast<std::size_t>(facts.definition);
    double squares = 0;
    for (std::size_t i = 0; i < surface.map.height.size(); ++i) {
      const double difference =
          double{walked.definitions[at].values[i]} - double{exact.definitions[at].values[i]};
      squares += difference * difference;
    }
    const double rmse = std::sqrt(squares / static_cast<double>(surface.map.height.size()));
    const DefinitionCheck& check = walked.evidence.definition_checks[at];
    INFO(facts.name << ", " << check.azimuths << " azimuths");
    CHECK(rmse < 1.15 * error);  // discretisation: what is asked for
    REQUIRE(check.rmse);
    CHECK(*check.rmse == Approx(rmse).epsilon(0.4));  // Monte Carlo: from 256 receivers
  }
}

TEST_CASE("definitions keep to the error that is asked for", "[visibility][definitions]") {
  const std::string shape = GENERATE("brick", "fbm");
  const double error = GENERATE(0.002, 0.01);
  INFO(shape << " " << error);
  check_promise(build_surface(make_synth_map(shape.c_str(), 64, Boundary::open, 0.2)), error);
}

TEST_CASE("rays find no horizons, and no definition is named twice", "[visibility][definitions]") {
  const Surface surface = round_surface(9, [](double r) { return r; });
  Request request =
      request_of({SkyDefinition::svf_tilted, SkyDefinition::terrain_view_factor}, Visibility::rays);
  CHECK_NOTHROW(solve(surface, request));
  request.wanted.definitions.push_back(SkyDefinition::mean_cos_h);
  CHECK_THROWS_AS(solve(surface, request), UsageError);
  CHECK_THROWS_AS(solve(surface, request_of({SkyDefinition::mean_cos_h, SkyDefinition::mean_cos_h},
                                            Visibility::horizon_walks)),
                  UsageError);
}

}  // namespace
}  // namespace heightlight
