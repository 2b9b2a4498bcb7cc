#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <iomanip>

#include "heightlight/curves.h"
#include "heightlight/files.h"
#include "scratch_folder.h"
#include "stability/profile_twin.h"
#include "test_maps.h"
#include "transport/simulated.h"
#include "visibility/exact_walk.h"

// Large beside small: offsets, depths, sums.

namespace heightlight {
namespace {

TEST_CASE("millimetres of relief a thousand kilometres up are the same as on the ground", "[stability]") {
  const ScratchFolder folder;
  const auto write_grid = [&](const std::string& name, double offset) {
    std::ofstream file(folder.path() / name);
    file << "ncols 9\nnrows 7\nxllcorner 0\nyllcorner 0\ncellsize 0.001\n"
         << std::fixed << std::setprecision(9);
    for (int i = 0; i < 63; ++i)
      file << offset + 1e-3 * unit_real(hash_combine(3, static_cast<std::uint64_t>(i))) << '\n';
    return folder.path() / name;
  };
  const Heightmap low = load_heightmap(write_grid("low.asc", 0), {}, 1 << 20).map;
  const Heightmap high = load_heightmap(write_grid("high.asc", 1e6), {}, 1 << 20).map;
  CHECK(high.base == Approx(1e6 + low.base).epsilon(1e-12));
  const Simulated here = simulate_map(low, by_exact_slices(16), 1);
  const Simulated there = simulate_map(high, by_exact_slices(16), 1);
  // discretisation of the text: a double holds 10⁶ to 10⁻¹⁰, a ten millionth of the relief
  CHECK((as_eigen(here.transport->direct) - as_eigen(there.transport->direct)).cwiseAbs().maxCoeff() < 1e-6);
}

TEST_CASE("the base of the heights changes nothing", "[stability]") {
  const Finder finder = GENERATE(by_rays(64), by_horizon_walks(), by_exact_slices(16));
  Heightmap map = make_rough_map(19, 17, Boundary::tile, 1e-3, 0, 1);
  const Simulated here = simulate_map(map, finder, 2);
  map.base = 1e6;
  const Simulated there = simulate_map(map, finder, 2);
  CHECK(here.bounces == there.bounces);
}

/// A square well of 3 × 3 bottom texels in level ground, open.
Heightmap well(double depth) {
  Heightmap map = make_map(9, 9, Boundary::open, [=](int row, int column) {
    return std::abs(row - 4) <= 1 && std::abs(column - 4) <= 1 ? 0.0 : depth;
  });
  map.spacing = {1, 1};
  return map;
}

TEST_CASE("where single precision ends, double goes on: A at the bottom of ever deeper wells",
          "[stability]") {
  const double depth = GENERATE(1.0, 1e2, 1e4, 1e6);
  const Surface surface = build_surface(well(depth));
  SliceView view;
  ExactWalker(surface, 32).view(4, 4, view);
  const auto expected = static_cast<double>(twin_sky(surface, 4, 4, 32).sky_view_factor);
  // A falls like depth⁻²; the horizon's angle from the zenith is kept as a cosine, so that A keeps its
  // digits.
  CHECK(expected < 6 / (depth * depth));
  CHECK(view.sky_view_factor == Approx(expected).epsilon(1e-12).margin(0));
  // Fast walks sum in single precision: good to 10⁻⁷ of the whole hemisphere, which below A = 10⁻⁷ is all of
  // A. Maps ask for no more; `--error 0` walks exactly.
  const WalkOptions walk{.azimuths = 32, .samples_per_octave = 32, .peak_share = 0.3F};
  const auto walked = build_horizon_transport(surface, {.sky = {.walk = walk}, .gather = {.walk = walk}});
  CHECK(std::fabs(walked->sky_view_factor(4, 4) - expected) < 3e-7);
}

TEST_CASE("an infinite trench is right at any depth that azimuths resolve", "[stability]") {
  constexpr int kWidth = 16;
  const double depth = GENERATE(1e-6, 1e-3, 1.0, 16.0, 64.0);  // in texels
  Heightmap map = make_map(64, 64, Boundary::tile, [&](int, int column) {
    return column >= 24 && column <= 24 + kWidth ? 0.0 : depth;
  });
  map.spacing = {1, 1};
  const Surface surface = build_surface(std::move(map));
  SliceView view;
  // The integrand has poles at asinh(distance/depth) from the real axis: K = 512 leaves exp(−512 · 0.14).
  ExactWalker(surface, 512).view(10, 32, view);
  const double expected = 9 / std::hypot(9.0, depth);
  CHECK(view.sky_view_factor == Approx(expected).epsilon(1e-9));
}

TEST_CASE("means of sixteen million values lose nothing that shows", "[stability][slow]") {
  constexpr std::size_t kCount = std::size_t{1} << 24;
  // 1 + tiny, alternating: a naive single-precision sum would stand still.
  Map ao(1 << 12, 1 << 12, 0.5F);
  TexelVector values(kCount);
  for (std::size_t i = 0; i < kCount; ++i) values[i] = 1 + (i % 2 == 0 ? 1e-9 : 3e-9);
  CurveBuilder builder(ao, AoKind::sky_view_factor, 10);
  builder.add(values);
  const BounceStatistics& statistics = builder.curves().filled.at(0).bounces.at(0);
  CHECK(statistics.mean - 1 == Approx(2e-9).epsilon(1e-6));  // identity: 2⁻⁵² of 1, to 10⁻⁷ of 2e-9
  CHECK(statistics.stddev == Approx(1e-9).epsilon(1e-4));
}

TEST_CASE("the form factors of sixty-five thousand rays sum to the rest of the hemisphere",
          "[stability][slow]") {
  const Surface surface = build_surface(well(3));
  const FormFactors rays = build_form_factors(surface, {.rays = 65536, .seed = 1}, {});
  CHECK(rays.link_count() > 700000);
  CHECK(row_sum_error(rays).largest < 1e-12);
}

}  // namespace
}  // namespace heightlight
