// Walks are planned for the light that they are for.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "heightlight/solve.h"
#include "heightlight/sun.h"
#include "solve/solver.h"
#include "test_maps.h"

namespace heightlight {
namespace {

constexpr double kLitError = 0.001;
constexpr double kLitAlbedo = 0.8;

Surface lit_ground() { return build_surface(make_synth_map("fbm", 64, Boundary::open, 0.3)); }

TexelVector low_sun(const Surface& surface) {
  return sun_irradiance(surface, {.azimuth_rad = -0.8, .elevation_rad = 0.5});
}

Request total_of(std::vector<TexelVector> direct) {
  return {.wanted = {.totals = {{.constant = {kLitAlbedo}}}, .direct = std::move(direct)},
          .accuracy = {.error = kLitError}};
}

double rms_apart(const TexelVector& a, const TexelVector& b) {
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) squares += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(squares / static_cast<double>(a.size()));
}

TEST_CASE("under a sun the first plan reaches the error wanted, by exact slices", "[solve]") {
  const Surface surface = lit_ground();
  const Request request = total_of({low_sun(surface)});
  const Results found = solve(surface, request);
  CHECK_FALSE(found.evidence.refined);
  CHECK(found.evidence.total_checks[0].total_rmse < kMissed * kLitError);
  Request exact = request;
  exact.accuracy = {.visibility = Visibility::exact_slices, .azimuths = 192};
  exact.checks.totals = false;
  const TexelVector truth = solve(surface, exact).totals[0][0];
  CHECK(rms_apart(found.totals[0][0], truth) < kMissed * kLitError);  // discretisation
}

TEST_CASE("a sun's gathers look in more directions than the sky's, wherever the plan is made", "[solve]") {
  const Surface surface = lit_ground();
  const Request by_sun = total_of({low_sun(surface)});
  const PlannedTransport for_sun = find_operator(surface, by_sun);
  const PlannedTransport for_sky = find_operator(surface, total_of({}));
  CHECK(for_sky.plan.gather.unevenness == 1);
  CHECK(for_sun.plan.gather.unevenness > 1.5);
  CHECK(for_sun.plan.gather.walk.azimuths > for_sky.plan.gather.walk.azimuths);
  Request lent = by_sun;
  lent.transport = &for_sun;
  CHECK(solve(surface, lent).totals == solve(surface, by_sun).totals);  // identity
}

TEST_CASE("of several lights a plan is for the one that asks most of it", "[solve]") {
  const Surface surface = lit_ground();
  const TexelVector sun = low_sun(surface);
  const TexelVector even(sun.size(), 0.5);
  const auto gather_plan = [&](std::vector<TexelVector> direct) {
    return find_operator(surface, total_of(std::move(direct))).plan.gather;
  };
  const GatherPlan of_sun = gather_plan({sun});
  const GatherPlan of_both = gather_plan({even, sun});
  // A, on which the even light hangs more, is walked more finely and leaves gathers somewhat less.
  CHECK(of_both.walk.azimuths >= of_sun.walk.azimuths);
  CHECK(of_both.walk.azimuths <= 2 * of_sun.walk.azimuths);
  CHECK(of_both.unevenness == Approx(of_sun.unevenness).epsilon(0.01));
}

TEST_CASE("light's unit changes neither plan nor relative error", "[solve]") {
  const Surface surface = lit_ground();
  TexelVector sun = low_sun(surface);
  const GatherPlan plan = find_operator(surface, total_of({sun})).plan.gather;
  for (double& light : sun) light *= 1024;
  const GatherPlan brighter = find_operator(surface, total_of({sun})).plan.gather;
  CHECK(brighter.walk.azimuths == plan.walk.azimuths);
  CHECK(brighter.walk.samples_per_octave == plan.walk.samples_per_octave);
  CHECK(brighter.error == plan.error);  // identity: a power of two
}

TEST_CASE("a plan for no light at all is made", "[solve]") {
  const Surface surface = lit_ground();
  const Results dark = solve(surface, total_of({TexelVector(64 * 64, 0.0)}));
  CHECK(*std::max_element(dark.totals[0][0].begin(), dark.totals[0][0].end()) == 0);
}

}  // namespace
}  // namespace heightlight
