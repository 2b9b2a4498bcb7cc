#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "base/texel_algebra.h"
#include "heightlight/error.h"
#include "test_maps.h"
#include "transport/gathered_ones.h"
#include "transport/simulated.h"

namespace heightlight {
namespace {

constexpr double kRowTolerance = 1e-13;  // identity: n·ε of 128 weights that sum to 1

double largest_difference(const TexelVector& a, const TexelVector& b) {
  return (as_eigen(a) - as_eigen(b)).cwiseAbs().maxCoeff();
}

TexelVector add(const TexelVector& a, const TexelVector& b) { return to_texels(as_eigen(a) + as_eigen(b)); }

bool same(const Map& a, const Map& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a.values[i] != b.values[i] && !(std::isnan(a.values[i]) && std::isnan(b.values[i]))) return false;
  }
  return a.size() == b.size();
}

TEST_CASE("sky + links = 1, and all bounces with their tail sum to 1", "[transport]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const double missing = GENERATE(0.0, 0.2);
  const auto [width, height] =
      GENERATE(std::pair{24, 24}, std::pair{37, 5}, std::pair{1, 11}, std::pair{3, 2});
  const double relief = GENERATE(0.02, 0.5);
  const Finder finder = GENERATE(by_rays(128), by_steady_walks(), by_exact_slices(16));
  CAPTURE(finder.name);
  const Simulated rough = simulate_map(make_rough_map(width, height, boundary, relief, missing, 2), finder);
  CHECK(gathered_ones_error(*rough.transport) < kRowTolerance);
  const TexelVector& sum = rough.series.sum;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const bool hole = std::isnan(rough.surface.map.height.values[i]);
    // the solver's residual, 10⁻⁸ (horizon walks: 10⁻⁶), divided by 1 − spectral radius
    CHECK(sum[i] + rough.tail.irradiance[i] == Approx(hole ? 0 : 1).margin(1e-5));
  }
}

TEST_CASE("the white furnace: under albedo 1 and a sky of 1 the irradiance is 1 everywhere", "[transport]") {
  const Finder finder = GENERATE(by_rays(128), by_horizon_walks(), by_exact_slices(16));
  CAPTURE(finder.name);
  const Simulated bricks = simulate_map(make_synth_map("brick", 48, Boundary::tile, 0.3), finder);
  const TexelVector ones(48 * 48, 1);
  const TexelVector after = add(bricks.bounces[0], gather(*bricks.transport, ones));
  CHECK(largest_difference(after, ones) < kRowTolerance);
}

TEST_CASE("a tail at constant albedo is what further bounces bring", "[transport][slow]") {
  const double albedo = GENERATE(0.3, 0.8, 1.0);
  const Finder finder = GENERATE(by_rays(128), by_steady_walks(), by_exact_slices(16));
  CAPTURE(finder.name);
  const Simulated few = simulate_map(make_synth_map("sines", 32, Boundary::tile, 0.3), finder, 4);
  const Simulated many = simulate_map(make_synth_map("sines", 32, Boundary::tile, 0.3), finder, 400);
  const TexelVector tail = solve_tail(*few.transport, few.series, albedo).irradiance;
  const TexelVector all = sum_of_bounces(many, albedo, 400);
  const TexelVector first = sum_of_bounces(many, albedo, 4);
  const TexelVector expected = to_texels(as_eigen(all) - as_eigen(first));
  // truncation at 400 bounces, the solver's residual: 10⁻⁸, and for the single precision of walks 10⁻⁶
  CHECK(largest_difference(tail, expected) < 100 * few.residual);
}

TEST_CASE("an albedo map of one value gives what that constant gives", "[transport]") {
  const Finder finder = GENERATE(by_rays(128), by_steady_walks(), by_exact_slices(16));
  CAPTURE(finder.name);
  const Simulated bricks = simulate_map(make_synth_map("brick", 32, Boundary::tile, 0.2), finder);
  const TexelVector albedo(32 * 32, 0.7);
  const TexelVector direct = bricks.transport->direct;
  const TexelVector varying = solve_equilibrium(*bricks.transport, direct, albedo, direct).irradiance;
  const TexelVector constant =
      add(sum_of_bounces(bricks, 0.7, 20), solve_tail(*bricks.transport, bricks.series, 0.7).irradiance);
  CHECK(largest_difference(varying, constant) < 100 * bricks.residual);
}

TEST_CASE("light bounces by the albedo of the place that it comes from", "[transport]") {
  // A trench with a white left half and a black right half: the black wall's neighbours lose its light.
  const Finder finder = GENERATE(by_rays(256), by_horizon_walks(), by_exact_slices(32));
  CAPTURE(finder.name);
  const Simulated trench = simulate_map(make_synth_map("trench", 32, Boundary::tile, 0.3), finder);
  TexelVector albedo(32 * 32);
  for (std::size_t i = 0; i < albedo.size(); ++i) albedo[i] = i % 32 < 16 ? 1 : 0;
  const TexelVector direct = trench.transport->direct;
  const TexelVector total = solve_equilibrium(*trench.transport, direct, albedo, direct).irradiance;
  CHECK((as_eigen(total) - as_eigen(direct)).minCoeff() > -0.1 * trench.residual);
  CHECK(total[16 * 32 + 19] - direct[16 * 32 + 19] > total[16 * 32 + 12] - direct[16 * 32 + 12]);
}

TEST_CASE("exchange is reciprocal: area times form factor is symmetric", "[transport]") {
  const Finder finder = GENERATE(by_rays(512), by_horizon_walks(), by_exact_slices(32));
  CAPTURE(finder.name);
  const Simulated sines = simulate_map(make_synth_map("sines", 64, Boundary::tile, 0.3), finder, 1);
  constexpr std::size_t n = 64 * 64;
  TexelVector x(n), y(n), area(n);
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = 1 + std::sin(0.1 * static_cast<double>(i % 64));
    y[i] = 2 + std::cos(0.2 * static_cast<double>(i / 64));
    area[i] = 1 / double{sines.surface.normal.values[i].z};
  }
  const TexelVector from_x = gather(*sines.transport, x);
  const TexelVector from_y = gather(*sines.transport, y);
  const double forth = as_eigen(area).cwiseProduct(as_eigen(y)).dot(as_eigen(from_x));
  const double back = as_eigen(area).cwiseProduct(as_eigen(x)).dot(as_eigen(from_y));
  CHECK(forth == Approx(back).epsilon(5e-3));  // discretisation: smooth normals stand for facets
}

TEST_CASE("the spectral radius is the ratio to which bounces settle", "[transport][slow]") {
  const Finder finder = GENERATE(by_rays(256), by_steady_walks(), by_exact_slices(16));
  CAPTURE(finder.name);
  const Simulated sines = simulate_map(make_synth_map("sines", 32, Boundary::tile, 0.3), finder, 400);
  const double ratio = as_eigen(sines.bounces[400]).sum() / as_eigen(sines.bounces[399]).sum();
  const Simulated early = simulate_map(make_synth_map("sines", 32, Boundary::tile, 0.3), finder, 20);
  CHECK(sines.series.spectral_radius == Approx(ratio).epsilon(1e-3));
  CHECK(early.series.spectral_radius == Approx(ratio).epsilon(0.05));
}

TEST_CASE("results do not depend on the number of threads", "[transport]") {
  const Heightmap map = make_rough_map(40, 29, Boundary::tile, 0.4, 0.1, 6);
  const ThreadScope one_thread(1);
  const Simulated one = simulate_map(map, 128);
  for (const int threads : {2, 7}) {
    const ThreadScope more_threads(threads);
    const Simulated other = simulate_map(map, 128);
    CHECK(same(one.transport->sky_view_factor, other.transport->sky_view_factor));
    CHECK(same(one.transport->ambient_occlusion, other.transport->ambient_occlusion));
    CHECK(one.bounces == other.bounces);
    CHECK(one.tail.irradiance == other.tail.irradiance);
  }
}

TEST_CASE("shifting a tiled map by whole periods of the rays' turns shifts the result, bit for bit",
          "[transport]") {
  const Heightmap map = make_synth_map("brick", 128, Boundary::tile, 0.2);
  const Simulated here = simulate_map(map, 64);
  const Simulated there = simulate_map(shift_map(map, 64, 64), 64);
  for (int row = 0; row < 128; ++row) {
    for (int column = 0; column < 128; ++column) {
      const std::size_t moved = map.height.index((row + 64) % 128, (column + 64) % 128);
      REQUIRE(here.bounces[3][map.height.index(row, column)] == there.bounces[3][moved]);
    }
  }
}

TEST_CASE("shifting by any other amount changes nothing but the rays' noise: there is no seam",
          "[transport][slow]") {
  const Heightmap map = make_synth_map("sines", 48, Boundary::tile, 0.3);
  const Simulated here = simulate_map(map, 4096, 1);
  const Simulated there = simulate_map(shift_map(map, 19, 31), 4096, 1);
  double worst_line = 0;  // a seam would stand out in its row's or column's mean
  for (int row = 0; row < 48; ++row) {
    double difference = 0;
    for (int column = 0; column < 48; ++column) {
      const double unmoved = here.bounces[0][map.height.index(row, column)];
      const double moved = there.bounces[0][map.height.index((row + 19) % 48, (column + 31) % 48)];
      difference += (unmoved - moved) / 48;
      CHECK(unmoved == Approx(moved).margin(0.01));
    }
    worst_line = std::max(worst_line, std::fabs(difference));
  }
  CHECK(worst_line < 8e-4);  // Monte Carlo: 0.001·√2/√48 (RMSE measured at 4096 rays), four times
}

TEST_CASE("turning a map by 90 degrees turns the result, up to the cells' diagonal", "[transport][slow]") {
  const Heightmap map = make_map(64, 64, Boundary::tile, [](int row, int column) {
    const double turn = 2 * std::numbers::pi / 64;
    return 0.05 * std::sin(turn * (2 * column + row)) + 0.04 * std::sin(turn * (4 * row - 3 * column) + 1.3);
  });
  Heightmap turned = map;
  for (int row = 0; row < 64; ++row) {
    for (int column = 0; column < 64; ++column) turned.height(63 - column, row) = map.height(row, column);
  }
  const auto [finder, texel_tolerance, mean_tolerance] = GENERATE(table<Finder, double, double>(
      {{by_rays(512), 4e-3, 3e-4},  // Monte Carlo, both maps; discretisation of the diagonal, h²-small here
       {by_steady_walks(), 1e-3, 3e-4},       // azimuths that a quarter of a turn takes to each other
       {by_exact_slices(32), 1e-3, 5e-4}}));  // the diagonal alone (measured: 4e-4 and 3.1e-4)
  CAPTURE(finder.name);
  const Simulated here = simulate_map(map, finder);
  const Simulated there = simulate_map(turned, finder);
  double squares = 0;
  double difference = 0;
  const TexelVector sum_here = sum_of_bounces(here, 0.8, 20);
  const TexelVector sum_there = sum_of_bounces(there, 0.8, 20);
  for (int row = 0; row < 64; ++row) {
    for (int column = 0; column < 64; ++column) {
      const double d =
          sum_here[map.height.index(row, column)] - sum_there[map.height.index(63 - column, row)];
      squares += d * d / 4096;
      difference += d / 4096;
    }
  }
  CHECK(std::sqrt(squares) < texel_tolerance);
  CHECK(std::fabs(difference) < mean_tolerance);
}

TEST_CASE("links that would not fit are refused before they are made", "[transport]") {
  const Surface surface = build_surface(make_synth_map("brick", 64, Boundary::tile, 0.3));
  try {
    build_form_factors(surface, {.rays = 256, .seed = 1}, {.memory = 100'000});
    FAIL("nothing was refused");
  } catch (const MemoryError& error) {
    CHECK(error.remedy == "memory");
    CHECK_THAT(error.what(), Catch::Contains("97.7 KiB"));
  }
  const RayOptions none{.rays = 0, .seed = 1};
  CHECK_THROWS_AS(build_form_factors(surface, none, {}), UsageError);
}

}  // namespace
}  // namespace heightlight
