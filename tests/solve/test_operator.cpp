// An operator that is found once serves many requests.

#include <catch2/catch.hpp>

#include "heightlight/error.h"
#include "heightlight/solve.h"
#include "heightlight/synth.h"

namespace heightlight {
namespace {

Surface steep_surface(const std::string& shape) {
  Image<float> heights = synthesize(shape, 24, 1);
  for (float& height : heights.values) height *= 0.3F;
  return build_surface({.height = heights, .spacing = {1.0 / 24, 1.0 / 24}});
}

TEST_CASE("totals and bounces by a lent operator are those of one's own, bit for bit", "[solve]") {
  const Surface surface = steep_surface("brick");
  Request request;
  request.accuracy.visibility =
      GENERATE(Visibility::horizon_walks, Visibility::exact_slices, Visibility::rays);
  request.accuracy.rays = 40;
  request.wanted = {.sky = true, .totals = {{.constant = {0.8}}}, .bounces = 2};
  const Results own = solve(surface, request);
  const PlannedTransport lent = find_operator(surface, {.accuracy = request.accuracy});
  request.transport = &lent;
  for (int time = 0; time < 2; ++time) {  // it is not used up
    const Results by_it = solve(surface, request);
    CHECK(by_it.totals == own.totals);
    CHECK(by_it.bounces == own.bounces);
    CHECK(by_it.tail == own.tail);
    CHECK(by_it.sky_view_factor == own.sky_view_factor);
    CHECK(by_it.ambient_occlusion == own.ambient_occlusion);
    CHECK(by_it.evidence.refined == own.evidence.refined);
  }
}

TEST_CASE("an operator of another surface is refused, and so are moments of one that has none", "[solve]") {
  const Surface surface = steep_surface("brick");
  const PlannedTransport lent = find_operator(surface, {});
  const Surface other = build_surface({.height = Image<float>(3, 3), .spacing = {1, 1}});
  CHECK_THROWS_WITH(solve(other, {.wanted = {.totals = {{.constant = {0.5}}}}, .transport = &lent}),
                    Catch::Contains("operator of the surface"));
  CHECK_THROWS_WITH(solve(surface, {.wanted = {.moments = {.first = true}, .totals = {{.constant = {0.5}}}},
                                    .transport = &lent}),
                    Catch::Contains("moments"));
}

}  // namespace
}  // namespace heightlight
