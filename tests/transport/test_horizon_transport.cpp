#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "base/hash.h"
#include "base/parallel.h"
#include "base/texel_algebra.h"
#include "heightlight/error.h"
#include "heightlight/transport.h"
#include "test_maps.h"
#include "transport/bounce_check.h"
#include "transport/exact_gather.h"
#include "transport/gathered_ones.h"
#include "transport/root_mean_square.h"
#include "transport/simulated.h"

namespace heightlight {
namespace {

HorizonPlan cheap_plan() {
  return {.sky = {.walk = {.azimuths = 16, .samples_per_octave = 16, .peak_share = 0.3F}},
          .gather = {.walk = {.azimuths = 12, .samples_per_octave = 8, .peak_share = 0.3F}}};
}

/// Of order 1, with a period of the map's size.
TexelVector smooth_field(const Surface& surface) {
  TexelVector x(surface.map.height.size());
  for (int row = 0; row < surface.height(); ++row) {
    for (int column = 0; column < surface.width(); ++column) {
      const double u = 2 * std::numbers::pi * column / surface.width();
      const double v = 2 * std::numbers::pi * row / surface.height();
      x[surface.map.height.index(row, column)] =
          0.5 + 0.25 * std::sin(2 * u + v) + 0.25 * std::cos(3 * v - u);
    }
  }
  return x;
}

TEST_CASE("walks find about as much surface as their sky leaves, the finer the nearer",
          "[transport][horizon]") {
  // What rises in small steps is left out, never counted twice or against: shares are from 0 to 1.
  const Surface surface = build_surface(make_rough_map(70, 66, Boundary::tile, 2, 0.1, 2));
  HorizonPlan plan = cheap_plan();
  plan.gather.first_bounce_azimuths = 64;
  double before = 1;
  for (const int samples_per_octave : {4, 8, 16, 32}) {
    plan.gather.walk.samples_per_octave = samples_per_octave;
    plan.sky.walk = {.azimuths = 64, .samples_per_octave = samples_per_octave, .peak_share = 0.3F};
    const auto transport = build_horizon_transport(surface, plan);
    for (const double share : transport->surface_share()) REQUIRE((share >= 0 && share < 1.001));
    const RowSumError error = row_sum_error(*transport);
    CHECK(error.rms > 1e-6);  // unlike a gather of ones, it can fail
    CHECK(error.largest >= error.rms);
    CHECK(error.rms < before);
    before = error.rms;
  }
  CHECK(before < 0.02);
}

TEST_CASE("what receivers see of a field lies between its lowest and its highest", "[transport][horizon]") {
  // A rise that is left out must not come back with a negative weight.
  const double relief = GENERATE(0.05, 0.5, 5.0);
  const Surface surface = build_surface(make_rough_map(67, 45, Boundary::tile, relief, 0.2, 7));
  const auto transport = build_horizon_transport(surface, cheap_plan());
  TexelVector spiky(surface.map.height.size());
  for (std::size_t i = 0; i < spiky.size(); ++i) spiky[i] = unit_real(scramble(i)) < 0.1 ? 1 : 0;
  const TexelVector gathered = transport->gather(spiky);
  for (std::size_t i = 0; i < gathered.size(); ++i)
    REQUIRE((gathered[i] >= 0 && gathered[i] <= 1 - transport->direct[i] + 1e-6));
}

TEST_CASE("two threads may gather at once", "[transport][horizon]") {
  const Surface surface = build_surface(make_rough_map(70, 66, Boundary::tile, 0.5, 0.1, 3));
  const auto transport = build_horizon_transport(surface, cheap_plan());
  const TexelVector x = smooth_field(surface);
  const TexelVector ones(x.size(), 1);
  const TexelVector alone = transport->gather(x);
  TexelVector beside;
  TexelVector other;
  std::thread one([&] { beside = transport->gather(x); });
  std::thread two([&] { other = transport->gather(ones); });
  one.join();
  two.join();
  CHECK(beside == alone);
  CHECK(other == transport->gather(ones));
}

TEST_CASE("plans that cannot be walked are refused", "[transport][horizon]") {
  const Surface surface = build_surface(make_rough_map(9, 9, Boundary::tile, 0.5, 0, 3));
  std::vector<HorizonPlan> bad(8, cheap_plan());
  bad[0].sky.walk.samples_per_octave = 0;
  bad[1].gather.walk.samples_per_octave = -3;
  bad[2].sky.walk.azimuths = 7;
  bad[3].gather.walk.azimuths = 65536;
  bad[4].gather.first_bounce_azimuths = 8192;
  bad[5].sky = {.walk = {.azimuths = 18}, .full_from = 0.3F};
  bad[6].sky.walk.peak_share = 2;
  bad[7].gather.walk.samples_per_octave = 1000;
  for (const HorizonPlan& plan : bad) CHECK_THROWS_AS(build_horizon_transport(surface, plan), UsageError);
  CHECK_NOTHROW(build_horizon_transport(surface, cheap_plan()));
}

TEST_CASE("an error that nothing reaches is planned for all the same", "[transport][horizon]") {
  const Surface surface = build_surface(make_rough_map(24, 24, Boundary::tile, 0.5, 0, 3));
  const PlannedTransport planned = plan_horizon_transport(surface, {.error = 1e-300});
  CHECK(planned.plan.sky.walk.azimuths >= 4);
  CHECK_NOTHROW(check_horizon_plan(planned.plan));
}

TEST_CASE("sky + F 1 = 1 in every row of horizon walks", "[transport][horizon]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const double missing = GENERATE(0.0, 0.3);
  const double relief = GENERATE(0.05, 5.0);
  const auto [width, height] =
      GENERATE(std::pair{70, 66}, std::pair{1, 37}, std::pair{90, 1}, std::pair{5, 3}, std::pair{1, 1});
  const Surface surface = build_surface(make_rough_map(width, height, boundary, relief, missing, 2));
  const auto transport = build_horizon_transport(surface, cheap_plan());
  CHECK(gathered_ones_error(*transport) < 1e-15);  // identity: the mean of ones is 1 to the last bit
  const TexelVector gathered = gather(*transport, smooth_field(surface));
  for (std::size_t i = 0; i < gathered.size(); ++i) {
    const bool hole = std::isnan(surface.map.height.values[i]);
    REQUIRE((hole ? gathered[i] == 0 : gathered[i] >= 0 && gathered[i] <= 1));
  }
}

TEST_CASE("a flat map is wholly open, and nothing of it is gathered", "[transport][horizon]") {
  const Surface surface = build_surface(make_map(40, 30, Boundary::tile, [](int, int) { return 0.3; }));
  const auto transport = build_horizon_transport(surface, cheap_plan());
  CHECK(transport->direct == TexelVector(40 * 30, 1));
  CHECK(gather(*transport, smooth_field(surface)) == TexelVector(40 * 30, 0));
}

TEST_CASE("horizon walks store no links, and gather the same each time", "[transport][horizon]") {
  const Surface surface = build_surface(make_rough_map(200, 130, Boundary::open, 0.2, 0.1, 3));
  const auto transport = build_horizon_transport(surface, cheap_plan());
  CHECK(transport->link_count() == 0);
  CHECK(transport->bytes() == 0);
  const TexelVector field = smooth_field(surface);
  const TexelVector first = gather(*transport, field);
  CHECK(gather(*transport, transport->direct) != first);
  CHECK(gather(*transport, field) == first);  // nothing is left over from the other
}

TEST_CASE("what walks gather of a sum is the sum of what they gather", "[transport][horizon]") {
  const Surface surface = build_surface(make_rough_map(70, 45, Boundary::tile, 0.2, 0.1, 3));
  const auto transport = build_horizon_transport(surface, cheap_plan());
  const TexelVector x = smooth_field(surface);
  const TexelVector& y = transport->direct;
  const TexelVector together = gather(*transport, to_texels(0.5 * as_eigen(x) + 3 * as_eigen(y)));
  const TexelVector apart =
      to_texels(0.5 * as_eigen(gather(*transport, x)) + 3 * as_eigen(gather(*transport, y)));
  // rounding, single precision
  CHECK((as_eigen(together) - as_eigen(apart)).cwiseAbs().maxCoeff() < 2e-6);
}

TEST_CASE("horizon walks do not depend on the number of threads, nor on when they run",
          "[transport][horizon]") {
  const Surface surface = build_surface(make_rough_map(150, 131, Boundary::tile, 0.3, 0.1, 6));
  const TexelVector field = smooth_field(surface);
  const ThreadScope one_thread(1);
  const auto one = build_horizon_transport(surface, cheap_plan());
  const TexelVector gathered = gather(*one, field);
  for (const int threads : {1, 2, 7}) {
    const ThreadScope more_threads(threads);
    const auto other = build_horizon_transport(surface, cheap_plan());
    CHECK(other->direct == one->direct);
    CHECK(gather(*other, field) == gathered);
  }
}

TEST_CASE("the plan does not depend on the number of threads", "[transport][horizon]") {
  const Surface surface = build_surface(make_synth_map("brick", 128, Boundary::tile, 0.2));
  const ThreadScope one_thread(1);
  const PlannedTransport one = plan_horizon_transport(surface, {.error = 0.004});
  for (const int threads : {2, 7}) {
    const ThreadScope more_threads(threads);
    const PlannedTransport other = plan_horizon_transport(surface, {.error = 0.004});
    CHECK(other.plan.sky.error == one.plan.sky.error);
    CHECK(other.plan.gather.error == one.plan.gather.error);
    CHECK(other.transport->direct == one.transport->direct);
    CHECK(gather(*other.transport, one.transport->direct) == gather(*one.transport, one.transport->direct));
  }
}

TEST_CASE("dim light is gathered as well as bright light, to the last bit", "[transport][horizon]") {
  const int dimming = GENERATE(-30, -140, -900);  // single precision ends at 2^-149
  const Surface surface = build_surface(make_synth_map("sines", 128, Boundary::tile, 0.3));
  const auto transport = build_horizon_transport(surface, cheap_plan());
  const double factor = std::ldexp(1.0, dimming);
  const TexelVector field = smooth_field(surface);
  const TexelVector bright = gather(*transport, field);
  CHECK(gather(*transport, to_texels(factor * as_eigen(field))) == to_texels(factor * as_eigen(bright)));
  CHECK(gather(*transport, TexelVector(field.size(), 0)) == TexelVector(field.size(), 0));
  const TexelVector dimmest = gather(*transport, TexelVector(field.size(), 1e-320));
  CHECK(as_eigen(dimmest).allFinite());
}

TexelVector difference(const TexelVector& a, const TexelVector& b) {
  return to_texels(as_eigen(a) - as_eigen(b));
}

/// The values of a map of `size` × `size` moved by whole texels around its torus.
TexelVector shift(const TexelVector& values, int size, int rows, int columns) {
  TexelVector shifted(values.size());
  const auto texel = [&](int row, int column) { return static_cast<std::size_t>(row * size + column); };
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      shifted[texel((row + rows) % size, (column + columns) % size)] = values[texel(row, column)];
    }
  }
  return shifted;
}

TEST_CASE("shifting a tiled map by whole tiles of receivers shifts the result, bit for bit",
          "[transport][horizon]") {
  constexpr int kSize = 128;
  const auto [rows, columns] = GENERATE(std::pair{64, 64}, std::pair{0, 64}, std::pair{64, 0});
  const Heightmap map = make_synth_map("brick", kSize, Boundary::tile, 0.2);
  const Surface here = build_surface(map);
  const Surface there = build_surface(shift_map(map, rows, columns));
  const auto transport = build_horizon_transport(here, cheap_plan());
  const auto shifted = build_horizon_transport(there, cheap_plan());
  CHECK(shifted->direct == shift(transport->direct, kSize, rows, columns));
  const TexelVector field = smooth_field(here);
  const TexelVector expected = shift(gather(*transport, field), kSize, rows, columns);
  const TexelVector got = gather(*shifted, shift(field, kSize, rows, columns));
  CHECK(got == expected);
}

TEST_CASE("any other shift changes A and gathers by no more than sampling errs: there is no seam",
          "[transport][horizon]") {
  constexpr int kSize = 96;
  const char* shape = GENERATE("sines", "brick");
  const Heightmap map = make_synth_map(shape, kSize, Boundary::tile, 0.2);
  const Surface here = build_surface(map);
  const Surface there = build_surface(shift_map(map, 19, 31));
  const HorizonPlan plan{.sky = {.walk = {.azimuths = 16, .samples_per_octave = 32, .peak_share = 0.3F}},
                         .gather = {.walk = {.azimuths = 32, .samples_per_octave = 16, .peak_share = 0.3F}}};
  const auto transport = build_horizon_transport(here, plan);
  const auto shifted = build_horizon_transport(there, plan);
  const TexelVector& field = transport->direct;
  const TexelVector sky = difference(shifted->direct, shift(transport->direct, kSize, 19, 31));
  const TexelVector light = difference(gather(*shifted, shift(field, kSize, 19, 31)),
                                       shift(gather(*transport, field), kSize, 19, 31));
  double worst_line = 0;  // a seam would stand out in its row's or column's mean
  for (int i = 0; i < kSize; ++i) {
    double in_row = 0;
    double in_column = 0;
    for (int j = 0; j < kSize; ++j) {
      in_row += sky[static_cast<std::size_t>(i * kSize + j)] / kSize;
      in_column += sky[static_cast<std::size_t>(j * kSize + i)] / kSize;
    }
    worst_line = std::max({worst_line, std::fabs(in_row), std::fabs(in_column)});
  }
  INFO(shape << ": A " << rms(sky) << ", in a line " << worst_line << ", light " << rms(light));
  // discretisation: √2 times what sampling costs on such maps, 7e-4 of A and 1.5e-3 of what is gathered,
  // where blocks of receivers that lie otherwise halve their azimuths otherwise (measured: 2e-4 and 1.1e-3;
  // in a line's mean 8e-5)
  CHECK(rms(sky) < 1e-3);
  CHECK(rms(light) < 2e-3);
  CHECK(worst_line < 3e-4);
}

/// RMS of the differences at some hundred receivers of a map of 128².
constexpr int kTried = 512;
std::size_t tried_texel(std::size_t i) { return scramble(i) % (128 * 128); }

/// What exact walks along 128 azimuths gather there.
std::vector<double> gather_exactly_where_tried(const Surface& surface, const TexelVector& field) {
  const ExactWalker walker(surface, 128);
  std::vector<double> exact(kTried);
  parallel_for(kTried, [&](std::int64_t i) {
    const int at = static_cast<int>(tried_texel(static_cast<std::size_t>(i)));
    SliceView view;
    walker.view(at / surface.width(), at % surface.width(), view);
    exact[static_cast<std::size_t>(i)] =
        gather_exactly(view, surface, [&](std::size_t seen) { return field[seen]; });
  });
  return exact;
}

TEST_CASE("gathers of the sky's light come near exact ones, ever nearer with azimuths and fineness",
          "[transport][horizon][slow]") {
  const std::string shape = GENERATE("brick", "fbm", "sines");
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const Surface surface = build_surface(make_synth_map(shape.c_str(), 128, boundary, 0.1));
  const auto plan = [](int azimuths, int samples_per_octave) {
    return HorizonPlan{
        .sky = {.walk = {.azimuths = 64, .samples_per_octave = 32, .peak_share = 0.3F}},
        .gather = {
            .walk = {.azimuths = azimuths, .samples_per_octave = samples_per_octave, .peak_share = 0.3F}}};
  };
  const TexelVector light = total_of(*build_horizon_transport(surface, plan(64, 32)), 0.8);
  const std::vector<double> exact = gather_exactly_where_tried(surface, light);
  struct Step {
    int azimuths, samples_per_octave;
    double bound;
  };
  // discretisation: of azimuths, fewer where little is seen, and of samples (measured, the worst of the six
  // maps: 4.3e-3, 1.8e-3, 8.7e-4 of a field of order 1, of which up to 0.14 is gathered)
  for (const auto& [azimuths, samples_per_octave, bound] :
       {Step{8, 8, 5e-3}, Step{16, 16, 2.2e-3}, Step{32, 32, 1.1e-3}}) {
    const TexelVector gathered =
        gather(*build_horizon_transport(surface, plan(azimuths, samples_per_octave)), light);
    double squares = 0;
    for (std::size_t i = 0; i < kTried; ++i) squares += std::pow(gathered[tried_texel(i)] - exact[i], 2);
    INFO(shape << ", " << to_string(boundary) << ", " << azimuths << " azimuths");
    CHECK(std::sqrt(squares / kTried) < bound);
  }
}

TEST_CASE("bounces of horizon walks come near those of exact slices, and bring no more light than there is",
          "[transport][horizon]") {
  const char* shape = GENERATE("brick", "sines");
  const double relief = GENERATE(0.1, 0.3);
  const Heightmap map = make_synth_map(shape, 64, Boundary::tile, relief);
  constexpr int kLast = 12;
  const Simulated exact = simulate_map(map, by_exact_slices(64), kLast);
  const Simulated walked = simulate_map(map, by_horizon_walks(), kLast);
  for (std::size_t b = 1; b <= kLast; ++b) {
    const double error = rms(as_eigen(walked.bounces[b]) - as_eigen(exact.bounces[b]));
    INFO(shape << ", relief " << relief << ", bounce " << b << ": " << error << " of "
               << rms(exact.bounces[b]));
    CHECK(error < 2.3e-3);  // discretisation: azimuths, fewer the less is left (measured: up to 1.8e-3)
  }
  CHECK(as_eigen(walked.series.sum).maxCoeff() < 1 + 1e-6);  // rounding, single precision
}

TEST_CASE("where light falls fast, noise of one bounce is not taken from the next", "[transport][horizon]") {
  const Heightmap map = make_synth_map("fbm", 96, Boundary::tile, 0.1);
  constexpr int kLast = 4;
  const Simulated exact = simulate_map(map, by_exact_slices(128), kLast);
  const Surface surface = build_surface(map);
  const PlannedTransport planned = plan_horizon_transport(surface, {.error = 0.002});
  std::vector<TexelVector> bounces;
  BounceCheck check(surface, planned.transport->direct, 1, {});
  std::vector<double> said;
  bounce(*planned.transport, surface, kLast, [&](int, const TexelVector& irradiance) {
    bounces.push_back(irradiance);
    said.push_back(check.take(irradiance));
  });
  for (std::size_t b = 1; b <= kLast; ++b) {
    const double mean = as_eigen(exact.bounces[b]).mean();
    const double error = rms(as_eigen(bounces[b]) - as_eigen(exact.bounces[b]));
    INFO("bounce " << b << ": mean " << as_eigen(bounces[b]).mean() / mean << " of what it is, error "
                   << error << ", said " << said[b]);
    // Cut to what is left over by the ones before, the third and fourth had a half and a third of their
    // light.
    CHECK(as_eigen(bounces[b]).mean() == Approx(mean).epsilon(0.1));
    // discretisation: few azimuths (measured: 0.03, 0.14, 0.2 and 0.3 of the mean)
    CHECK(error < (b == 1 ? 0.06 : 0.5) * mean);
    // Monte Carlo: 128 receivers, the later the fewer of which see most of what is wrong
    CHECK(said[b] == Approx(error).epsilon(b < 3 ? 0.3 : 0.6));
  }
}

TEST_CASE("bounces do not hang on single rows of the map", "[transport][horizon]") {
  // Every fourth row is missing, as a sample of rows might meet.
  const Heightmap map = make_map(12, 12, Boundary::tile, [](int row, int column) {
    return row % 4 == 0 ? std::nan("")
                        : 3 * unit_real(hash_combine(1, static_cast<std::uint64_t>(12 * row + column)));
  });
  const Simulated walked = simulate_map(map, by_horizon_walks(), 6);
  const Simulated exact = simulate_map(map, by_exact_slices(64), 6);
  for (std::size_t b = 1; b <= 6; ++b) {
    INFO("bounce " << b);
    CHECK(as_eigen(walked.bounces[b]).sum() == Approx(as_eigen(exact.bounces[b]).sum()).epsilon(0.2));
  }
}

TEST_CASE("numbers of azimuths outside their range are refused", "[transport][horizon]") {
  const Surface surface = build_surface(make_map(4, 4, Boundary::tile, [](int, int) { return 0; }));
  for (const int azimuths : {-2, 0, 1, 7, 65538}) {
    const WalkOptions good{.azimuths = 8, .samples_per_octave = 8};
    const WalkOptions bad{.azimuths = azimuths, .samples_per_octave = 8};
    const HorizonPlan bad_sky{.sky = {.walk = bad}, .gather = {.walk = good}};
    const HorizonPlan bad_gather{.sky = {.walk = good}, .gather = {.walk = bad}};
    const HorizonPlan bad_bounce{.sky = {.walk = good},
                                 .gather = {.walk = good, .first_bounce_azimuths = azimuths}};
    CHECK_THROWS_AS(build_horizon_transport(surface, bad_sky), UsageError);
    CHECK_THROWS_AS(build_horizon_transport(surface, bad_gather), UsageError);
    CHECK_THROWS_AS(build_horizon_transport(surface, bad_bounce), UsageError);
  }
  const auto plan = [&](const HorizonGoal& goal) { plan_horizon_transport(surface, goal); };
  CHECK_THROWS_AS(plan({.error = 0}), UsageError);
  CHECK_THROWS_AS(plan({.error = std::nan("")}), UsageError);
  CHECK_THROWS_AS(plan({.error = 0.01, .azimuths = 7}), UsageError);
}

}  // namespace
}  // namespace heightlight
