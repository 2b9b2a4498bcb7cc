// One call: what is asked for is found, and nothing else; whatever else is asked for, on however many
// threads.

#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <thread>

#include "base/byte_size.h"
#include "base/texel_algebra.h"
#include "heightlight/error.h"
#include "heightlight/forms.h"
#include "heightlight/solve.h"
#include "heightlight/synth.h"

namespace heightlight {
namespace {

Surface make_surface(const std::string& shape, int size, float relief) {
  Image<float> heights = synthesize(shape, size, 1);
  for (float& height : heights.values) height *= relief;
  return build_surface({.height = heights, .spacing = {1.0 / size, 1.0 / size}});
}

double largest_difference(const TexelVector& a, const TexelVector& b) {
  return (as_eigen(a) - as_eigen(b)).cwiseAbs().maxCoeff();
}

Request coarse_request() {
  Request request;
  request.accuracy.error = 0.01;
  return request;
}

/// Of everything at once.
Request whole_request() {
  Request request = coarse_request();
  request.wanted = {.sky = true,
                    .moments = {.first = true, .second = true},
                    .horizon_rad = {0, 1},
                    .totals = {{.constant = {0.5}}, {.constant = {0.9, 0.2, 0}}},
                    .seen = true,
                    .bounces = 3};
  return request;
}

}  // namespace

TEST_CASE("a solve that did not converge is told", "[solve]") {
  Evidence evidence;
  CHECK(find_faults(evidence).empty());
  evidence.solver_residual = 1e-8;
  CHECK(find_faults(evidence).empty());
  evidence.solver_iterations = 2000;
  for (const double residual : {1e-3, std::numeric_limits<double>::quiet_NaN()}) {
    evidence.solver_residual = residual;
    REQUIRE(find_faults(evidence).size() == 1);
    CHECK(find_faults(evidence)[0].find("did not converge: after 2000 steps") != std::string::npos);
  }
}

TEST_CASE("a plan that cannot be walked is refused before anything is found", "[solve]") {
  Request request = coarse_request();
  request.wanted.sky = true;
  request.accuracy.plan = HorizonPlan{.sky = {.walk = {.azimuths = 16, .samples_per_octave = 0}}};
  CHECK_THROWS_AS(solve(make_surface("brick", 16, 0.1F), request), UsageError);
}

TEST_CASE("only what is asked for is found", "[solve]") {
  const Surface surface = make_surface("brick", 64, 0.1F);
  Request request = coarse_request();
  request.wanted.sky = true;
  const Results sky = solve(surface, request);
  CHECK(sky.sky_view_factor.size() == 64 * 64);
  CHECK(sky.ambient_occlusion.size() == 64 * 64);
  CHECK(sky.moments.first.size() == 0);
  CHECK(sky.totals.empty());
  CHECK(sky.seen.size() == 0);
  CHECK_FALSE(sky.evidence.has_links);
  REQUIRE(sky.evidence.sky_check);
  CHECK(sky.evidence.sky_check->sky_view_factor < 0.015);
  CHECK(sky.evidence.total_checks.empty());
  CHECK_FALSE(sky.evidence.energy);

  request.wanted = {.totals = {{.constant = {0.5}}}};
  request.checks = {.sky = false, .totals = false};
  const Results total = solve(surface, request);
  CHECK(total.sky_view_factor.size() == 0);
  REQUIRE(total.totals.size() == 1);
  CHECK(total.totals[0].size() == 1);
  CHECK(total.evidence.has_links);
  CHECK(total.evidence.total_checks.empty());
  CHECK_FALSE(total.evidence.sky_check);
}

TEST_CASE("everything at once is found, with its evidence", "[solve]") {
  const Surface surface = make_surface("cobbles", 64, 0.2F);
  const Results all = solve(surface, whole_request());
  CHECK(all.moments.second.size() == surface.map.height.size());
  CHECK(all.horizons.size() == 2);
  REQUIRE(all.totals.size() == 2);
  CHECK(all.totals[1].size() == 3);
  REQUIRE(all.bounces.size() == 4);
  REQUIRE(all.evidence.energy);
  CHECK(all.evidence.energy->sum_max_error < 1e-5);
  CHECK(all.evidence.seen->mean == Approx(all.evidence.seen->expected).margin(0.1));
  REQUIRE(all.evidence.total_checks.size() == 2);
  for (const HorizonCheck& check : all.evidence.total_checks) CHECK(check.total_rmse < 0.02);
  CHECK(all.evidence.estimated_bytes > 0);

  TexelVector sum = all.tail;
  for (const TexelVector& bounce : all.bounces) as_eigen(sum) += as_eigen(bounce);
  CHECK(largest_difference(sum, TexelVector(sum.size(), 1)) < 1e-5);
  for (std::size_t i = 0; i < all.seen.size(); ++i) {
    const SkyViewFactor sky(double{all.whole_sky_view_factor.values[i]});
    const double black = all.totals[1][2][i];
    REQUIRE(black == Approx(sky.value).margin(1e-6));
  }
  const Image<Vector3> bent = bent_normals(all.moments, surface);
  for (const Vector3& direction : bent.values) REQUIRE(as_eigen(direction).norm() == Approx(1).margin(1e-5));
}

TEST_CASE("a quantity does not depend on what else is asked for", "[solve]") {
  const Surface surface = make_surface("brick", 64, 0.1F);
  Request request = coarse_request();
  request.wanted = {.sky = true, .totals = {{.constant = {0.5}}}};
  const Results one = solve(surface, request);
  request.wanted.totals = {{.constant = {0.9}}, {.constant = {0.5}}};
  request.wanted.seen = true;
  const Results more = solve(surface, request);
  CHECK(one.sky_view_factor == more.sky_view_factor);
  CHECK(one.totals[0] == more.totals[1]);
  request.wanted = {.sky = true};
  CHECK(one.sky_view_factor == solve(surface, request).sky_view_factor);
}

TEST_CASE("n gives the total back that it was solved for", "[solve]") {
  const Surface surface = make_surface("fbm", 64, 0.2F);
  Request request = coarse_request();
  request.wanted = {.totals = {{.constant = {kSeenAlbedo}}}, .seen = true};
  const Results results = solve(surface, request);
  for (std::size_t i = 0; i < results.seen.size(); ++i) {
    const double total = bounced_total(SkyViewFactor(double{results.whole_sky_view_factor.values[i]}),
                                       SeenSkyViewFactor(double{results.seen.values[i]}), kSeenAlbedo);
    REQUIRE(total == Approx(results.totals[0][0][i]).margin(2e-6));
  }
}

TEST_CASE("walks, slices and rays agree through the one call", "[solve]") {
  const Surface surface = make_surface("cobbles", 48, 0.15F);
  Request request;
  request.wanted = {.sky = true, .totals = {{.constant = {0.7}}}};
  request.accuracy.error = 0.003;
  const Results walked = solve(surface, request);
  request.accuracy = {.visibility = Visibility::exact_slices, .azimuths = 96};
  const Results sliced = solve(surface, request);
  request.accuracy = {.visibility = Visibility::rays, .rays = 2000};
  const Results cast = solve(surface, request);
  for (const Results* other : {&walked, &cast}) {
    const auto rms = [](const TexelVector& a, const TexelVector& b) {
      return std::sqrt((as_eigen(a) - as_eigen(b)).squaredNorm() / static_cast<double>(a.size()));
    };
    CHECK(rms(other->totals[0][0], sliced.totals[0][0]) < 0.006);
  }
  CHECK(walked.evidence.plan);
  CHECK(sliced.evidence.azimuths == 96);
  CHECK(cast.evidence.rays == 2000);
  CHECK(*cast.evidence.sky_rmse < 0.02);
  // Without bounces no links are stored, and the sky is the same.
  request.wanted.totals.clear();
  const Results sky = solve(surface, request);
  CHECK(sky.sky_view_factor == cast.sky_view_factor);
  request.accuracy = {.visibility = Visibility::exact_slices, .azimuths = 96};
  const Results slices = solve(surface, request);
  CHECK_FALSE(slices.evidence.has_links);
  for (std::size_t i = 0; i < slices.sky_view_factor.size(); ++i) {
    REQUIRE(slices.sky_view_factor.values[i] == Approx(sliced.sky_view_factor.values[i]).margin(1e-6));
  }
}

TEST_CASE("light of one's own bounces like the sky's", "[solve]") {
  const Surface surface = make_surface("brick", 48, 0.1F);
  Request request = coarse_request();
  request.accuracy = {.visibility = Visibility::exact_slices, .azimuths = 32};
  request.wanted = {.sky = true, .totals = {{.constant = {0.6}}}};
  const Results by_sky = solve(surface, request);
  TexelVector& direct = request.wanted.direct.emplace_back();
  direct.assign(by_sky.sky_view_factor.values.begin(), by_sky.sky_view_factor.values.end());
  const Results by_own = solve(surface, request);
  // The sky's bounces end by what energy says is left, one's own by a bound of it: within a share of the
  // error.
  CHECK(largest_difference(by_own.totals[0][0], by_sky.totals[0][0]) < 0.2 * request.accuracy.error);
  CHECK(by_own.evidence.total_checks[0].total_rmse < 0.01);
  for (double& value : direct) value *= 2;
  const Results twice = solve(surface, request);
  CHECK(largest_difference(twice.totals[0][0], to_texels(2 * as_eigen(by_own.totals[0][0]))) < 1e-5);
  request.wanted.bounces = 2;
  CHECK_THROWS_WITH(solve(surface, request), Catch::Contains("direct"));
}

TEST_CASE("three channels of light bounce each for itself", "[solve]") {
  const Surface surface = make_surface("fbm", 48, 0.3F);
  Request request = coarse_request();
  request.accuracy = {.visibility = Visibility::exact_slices, .azimuths = 32};
  request.wanted = {.totals = {{.constant = {0.6}}, {.constant = {0.2, 0.4, 0.6}}}};
  for (const double brightness : {1.0, 2.0, 0.5})
    request.wanted.direct.emplace_back(surface.map.height.size(), brightness);
  const Results all = solve(surface, request);
  REQUIRE(all.totals[0].size() == 3);
  CHECK(all.totals[0][2] == all.totals[1][2]);
  request.wanted = {.totals = {{.constant = {0.4}}}, .direct = {request.wanted.direct[1]}};
  CHECK(solve(surface, request).totals[0][0] == all.totals[1][1]);
  request.wanted.totals = {{.constant = {0.4, 0.5}}};
  request.wanted.direct.resize(3, request.wanted.direct[0]);
  CHECK_THROWS_WITH(solve(surface, request), Catch::Contains("direct"));
}

TEST_CASE("what is received is absorbed or escapes, as well as samples resolve the surface", "[solve]") {
  Request request = coarse_request();
  request.accuracy = {.visibility = Visibility::exact_slices, .azimuths = 64};
  request.wanted = {.totals = {{.constant = {0.2}}, {.constant = {0.8}}, {.constant = {1}}}};
  std::vector<EnergyAudit> coarser;
  for (const int side : {32, 64}) {
    const Surface surface = build_surface(make_map(side, side, Boundary::tile, [side](int row, int column) {
      return 0.05 * std::sin(12.5663706 * column / side) * std::cos(12.5663706 * row / side);
    }));
    const std::vector<EnergyAudit> audits = solve(surface, request).evidence.audits;
    REQUIRE(audits.size() == 3);
    CHECK(audits[0].absorbed > 0.7);
    CHECK(audits[2].absorbed == 0);
    CHECK(std::abs(audits[2].imbalance) < 1e-7);  // all is 1 there, which is the solver's tolerance
    for (std::size_t i = 0; i < coarser.size() && i < 2; ++i) {
      INFO(coarser[i].imbalance << " becomes " << audits[i].imbalance);
      CHECK(std::abs(audits[i].imbalance) < 0.5 * std::abs(coarser[i].imbalance));  // discretisation
    }
    coarser = audits;
  }
}

TEST_CASE("light of one's own is balanced, and no worse for it", "[solve]") {
  const Surface surface = build_surface(make_map(64, 64, Boundary::open, [](int row, int column) {
    return 0.05 * std::sin(0.3 * column) * std::cos(0.25 * row);
  }));
  TexelVector lit(surface.map.height.size());
  for (std::size_t i = 0; i < lit.size(); ++i)
    lit[i] = std::max(0.0F, surface.normal.values[i].x);  // a sun in the east, without its shadows
  Request request = coarse_request();
  request.wanted = {.totals = {{.constant = {0.9}}}, .direct = {lit}};
  request.accuracy = {.error = 0.002};
  const Results walked = solve(surface, request);
  request.accuracy = {.visibility = Visibility::exact_slices, .azimuths = 128};
  const Results exact = solve(surface, request);
  for (const Results* found : {&walked, &exact})
    CHECK(std::abs(found->evidence.audits.at(0).imbalance) < 1e-9);   // identity
  CHECK(std::abs(walked.evidence.audits[0].found_imbalance) > 1e-6);  // what walks err by is not hidden
  const Eigen::VectorXd error = as_eigen(walked.totals[0][0]) - as_eigen(exact.totals[0][0]);
  CHECK(error.norm() / std::sqrt(static_cast<double>(lit.size())) < 1.15 * 0.002);
}

TEST_CASE("bounces go to a sink, which need not keep them", "[solve]") {
  struct Counter : BounceSink {
    void take_sky(const Map& alpha, const Map& sky) override { texels = alpha.size() + sky.size(); }
    void take_bounce(int b, const TexelVector& irradiance) override {
      CHECK(b == bounces);
      ++bounces;
      as_eigen(sum) += as_eigen(irradiance);
    }
    void take_tail(const TexelVector& irradiance) override { as_eigen(sum) += as_eigen(irradiance); }
    std::size_t texels = 0;
    int bounces = 0;
    TexelVector sum = TexelVector(32 * 32, 0);
  };
  const Surface surface = make_surface("fbm", 32, 0.3F);
  Request request = coarse_request();
  request.wanted.bounces = 5;
  Counter counter;
  request.sink = &counter;
  const Results results = solve(surface, request);
  CHECK(results.bounces.empty());
  CHECK(counter.texels == 2 * 32 * 32);
  CHECK(counter.bounces == 6);
  CHECK(largest_difference(counter.sum, TexelVector(32 * 32, 1)) < 1e-5);
}

TEST_CASE("two solutions at once are what each is alone", "[solve]") {
  const Surface wall = make_surface("brick", 96, 0.1F);
  const Surface ground = make_surface("fbm", 80, 0.3F);
  Request request = whole_request();
  request.limits.threads = 1;
  const Results wall_alone = solve(wall, request);
  const Results ground_alone = solve(ground, request);
  Results wall_beside;
  Results ground_beside;
  std::thread other([&] {
    Request own = request;
    own.limits.threads = 3;
    ground_beside = solve(ground, own);
  });
  request.limits.threads = 2;
  wall_beside = solve(wall, request);
  other.join();
  const auto same = [](const Results& a, const Results& b) {
    CHECK(a.sky_view_factor == b.sky_view_factor);
    CHECK(a.moments.first == b.moments.first);
    CHECK(a.totals == b.totals);
    CHECK(a.bounces == b.bounces);
    CHECK(a.seen == b.seen);
    CHECK(a.evidence.total_checks[0].total_rmse == b.evidence.total_checks[0].total_rmse);
  };
  same(wall_alone, wall_beside);
  same(ground_alone, ground_beside);
}

TEST_CASE("a watch hears of every step, and ends the work", "[solve]") {
  const Surface surface = make_surface("brick", 96, 0.1F);
  Request request = whole_request();
  std::atomic<int> begun{0};
  std::atomic<int> ended{0};
  std::atomic<int> at_once{0};
  request.watch.tell = [&](const Step& step) {
    CHECK(++at_once == 1);
    if (step.done == 0 && !step.ended) ++begun;
    if (step.ended) ++ended;
    CHECK(step.done >= 0);
    if (step.total > 0) CHECK(step.done <= step.total);
    --at_once;
  };
  solve(surface, request);
  CHECK(begun >= 5);
  CHECK(ended >= 5);
  // Wherever it is asked to stop, it does.
  std::atomic<int> asked{0};
  request.watch = {.tell = {}, .stopped = [&] { return ++asked < 0; }};
  solve(surface, request);
  const int questions = asked;
  REQUIRE(questions > 20);
  for (const int last : {1, questions / 4, questions / 2, questions * 9 / 10}) {
    asked = 0;
    request.watch.stopped = [&] { return ++asked > last; };
    CHECK_THROWS_AS(solve(surface, request), Cancelled);
  }
}

TEST_CASE("requests without sense name the quantity", "[solve]") {
  const Surface surface = make_surface("sines", 16, 0.1F);
  const auto quantity_of = [&](const Request& request) {
    try {
      solve(surface, request);
    } catch (const UsageError& error) {
      CHECK(std::string(error.what()).find("--") == std::string::npos);
      return error.quantity;
    }
    return std::string("none");
  };
  const auto with = [](auto&& change) {
    Request request;
    request.wanted.sky = true;
    change(request);
    return request;
  };
  CHECK(quantity_of(with([](Request&) {})) == "none");
  CHECK(quantity_of(with([](Request& r) { r.accuracy.error = 0; })) == "error");
  CHECK(quantity_of(with([](Request& r) { r.accuracy.error = NAN; })) == "error");
  CHECK(quantity_of(with([](Request& r) { r.accuracy.azimuths = 7; })) == "azimuths");
  CHECK(quantity_of(with([](Request& r) { r.accuracy = {.visibility = Visibility::rays, .rays = 0}; })) ==
        "rays");
  CHECK(quantity_of(with([](Request& r) { r.wanted.bounces = -1; })) == "bounces");
  CHECK(quantity_of(with([](Request& r) { r.wanted.maximum_distance = MaximumDistance{.distance = -1}; })) ==
        "max_distance");
  CHECK(quantity_of(with([](Request& r) { r.wanted.totals = {{}}; })) == "albedo");
  CHECK(quantity_of(with([](Request& r) { r.wanted.totals = {{.constant = {2}}}; })) == "albedo");
  CHECK(quantity_of(with([](Request& r) { r.wanted.totals = {{.varying = {TexelVector(3, 0.5)}}}; })) ==
        "albedo");
  CHECK(quantity_of(with([](Request& r) { r.wanted.direct = {{1.0}}; })) == "direct");
  CHECK(quantity_of(with([](Request& r) {
          r.accuracy.visibility = Visibility::rays;
          r.wanted.moments.first = true;
        })) == "visibility");
}

TEST_CASE("memory that does not do is refused before any is taken", "[solve]") {
  const Surface surface = make_surface("sines", 64, 0.1F);
  Request request = whole_request();
  const std::uint64_t needed = estimate_memory(64, 64, request);
  request.limits.memory = needed - 1;
  try {
    solve(surface, request);
    FAIL("nothing was refused");
  } catch (const MemoryError& error) {
    CHECK(error.missing == 1);
    CHECK(error.remedy == "memory " + write_enough(needed));
    CHECK_THAT(error.what(), Catch::Contains("64 × 64") && Catch::Contains("MiB"));
  }
  // That much is enough: walks store no links.
  request.limits.memory = needed;
  const Results tight = solve(surface, request);
  request.limits.memory = ~0ULL;
  CHECK(tight.totals == solve(surface, request).totals);
  CHECK(tight.evidence.links == 0);
  CHECK(tight.evidence.link_bytes == 0);
}

TEST_CASE("surfaces are checked", "[solve]") {
  const Image<float> heights(4, 4, 0.0F);
  CHECK_THROWS_AS(build_surface({.height = {}, .spacing = {1, 1}}), UsageError);
  CHECK_THROWS_AS(build_surface({.height = heights, .spacing = {0, 1}}), UsageError);
  CHECK_THROWS_AS(build_surface({.height = heights, .spacing = {1, NAN}}), UsageError);
  Image<float> infinite = heights;
  infinite(1, 1) = INFINITY;
  CHECK_THROWS_AS(build_surface({.height = infinite, .spacing = {1, 1}}), UsageError);
  Image<float> short_of_one = heights;
  short_of_one.values.pop_back();
  CHECK_THROWS_AS(build_surface({.height = short_of_one, .spacing = {1, 1}}), UsageError);
}

TEST_CASE("heights count from anywhere", "[solve]") {
  const Surface surface = make_surface("cobbles", 64, 0.125F);
  Heightmap lowered = surface.map;
  for (float& height : lowered.height.values) height -= 0.5F;
  Request request = coarse_request();
  request.wanted = {.sky = true};
  const Map above = solve(surface, request).sky_view_factor;
  const Map below = solve(build_surface(lowered), request).sky_view_factor;
  for (std::size_t i = 0; i < above.size(); ++i)
    REQUIRE(above.values[i] == Approx(below.values[i]).margin(2e-5));
}

}  // namespace heightlight
