#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "visibility/exact_walk.h"
#include "visibility/horizon_sky.h"
#include "visibility/walked_tiles.h"

namespace heightlight {
namespace {

HorizonSky walk(const Surface& surface, const WalkOptions& options) {
  return walk_horizon_sky(surface, build_height_pyramid(surface), {.walk = options});
}

struct Terrain {
  const char* name;
  bool rough;
  int width, height;
  double relief;
  double missing;
  double stretch;  // spacing.y / spacing.x
};

Surface make_surface(const Terrain& terrain, Boundary boundary) {
  Heightmap map = terrain.rough ? make_rough_map(terrain.width, terrain.height, boundary, terrain.relief,
                                                 terrain.missing, 9)
                                : make_smooth_map(terrain.width, terrain.height, boundary, terrain.relief);
  map.spacing.y *= terrain.stretch;
  return build_surface(std::move(map));
}

/// Largest difference of two sums, per azimuth.
double difference(const std::vector<float>& a, const std::vector<float>& b, int azimuths) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    worst = std::max(worst, std::fabs(double{a[i]} - double{b[i]}) / azimuths);
  }
  return worst;
}

struct LineDifference {
  int heights = 0;          // lines that differ
  double per_distance = 0;  // largest relative difference
};

LineDifference difference(const std::vector<FarView>& a, const std::vector<FarView>& b) {
  LineDifference result;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t line = 0; line < FarView::kLines; ++line) {
      for (std::size_t group = 0; group < FarView::kGroups; ++group) {
        result.heights += a[i].height[line][group] != b[i].height[line][group];
        const double ratio = double{a[i].per_distance[line][group]} / double{b[i].per_distance[line][group]};
        result.per_distance = std::max(result.per_distance, std::fabs(ratio - 1));
      }
    }
  }
  return result;
}

TEST_CASE("the sky walk's lanes and its scalar twin agree on every instruction set", "[visibility][walk]") {
  const Terrain terrain = GENERATE(
      Terrain{"smooth, prime sides", false, 67, 131, 0.1, 0, 1},
      Terrain{"smooth, tall", false, 61, 37, 10, 0, 1}, Terrain{"rough", true, 80, 64, 0.1, 0, 1},
      Terrain{"rough, tall", true, 61, 37, 10, 0, 1}, Terrain{"rough, holes", true, 97, 41, 0.1, 0.3, 1},
      Terrain{"oblong texels, holes", true, 64, 64, 0.2, 0.3, 2.5}, Terrain{"a texel", true, 1, 1, 0.1, 0, 1},
      Terrain{"a column", true, 1, 23, 0.1, 0, 1}, Terrain{"a row", true, 71, 1, 0.1, 0, 1},
      Terrain{"tiny", true, 5, 3, 0.3, 0, 0.4});
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const int samples_per_octave = GENERATE(8, 32);
  const Surface surface = make_surface(terrain, boundary);
  const WalkOptions options{.azimuths = 6, .samples_per_octave = samples_per_octave, .peak_share = 0.3F};
  const WalkedSky twin = walk_sky_with(look_far_scalar, walk_sky_scalar, surface, options);
  for (const std::int64_t target : instruction_sets()) {
    const InstructionSet use(target);
    const WalkedSky lanes = walk_sky_with(look_far, walk_sky, surface, options);
    INFO(terrain.name << ", " << to_string(boundary) << ", fineness " << samples_per_octave << ", "
                      << hwy::TargetName(target));
    const LineDifference lines = difference(lanes.views, twin.views);
    CHECK(lines.heights == 0);
    CHECK(lines.per_distance <= 2e-7);  // rounding: a fused product or two, 1.2e-7 measured
    // rounding: slopes of heights h apart at a texel's distance d cancel to ε h/d, 10⁻⁴ on tall maps, where
    // slices are that much flatter in them (measured: 3e-7, tall 1.4e-6)
    const double rounding = terrain.relief > 1 ? 4e-6 : 1e-6;
    CHECK(difference(lanes.sky, twin.sky, options.azimuths) < rounding);
    CHECK(difference(lanes.full, twin.full, options.azimuths) < rounding);
    CHECK(difference(lanes.solid, twin.solid, options.azimuths) < rounding);
  }
}

TEST_CASE("with its fineness the walk converges to the exact one along the same azimuths",
          "[visibility][walk]") {
  const std::string shape = GENERATE("brick", "fbm", "sines");
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  constexpr int kSize = 128;
  constexpr int kAzimuths = 16;
  const Surface surface = build_surface(make_synth_map(shape.c_str(), kSize, boundary, 0.1));
  const ExactWalker walker(surface, kAzimuths);
  constexpr int kStep = 4;  // every fourth row is compared
  std::vector<SkyShare> exact(kSize / kStep * kSize);
  parallel_for(kSize / kStep, [&](std::int64_t i) {
    SliceView view;
    for (int column = 0; column < kSize; ++column) {
      walker.view(static_cast<int>(i) * kStep, column, view);
      exact[static_cast<std::size_t>(i * kSize + column)] = {view.ambient_occlusion, view.sky_view_factor};
    }
  });
  double sky_before = 1;
  double ambient_before = 1;
  for (const int samples_per_octave : {8, 16, 32, 64}) {
    const HorizonSky walked =
        walk(surface, {.azimuths = kAzimuths, .samples_per_octave = samples_per_octave, .peak_share = 0.3F});
    double sky = 0;
    double ambient = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const int row = static_cast<int>(i) / kSize * kStep;
      const int column = static_cast<int>(i) % kSize;
      sky += std::pow(double{walked.sky_view_factor(row, column)} - exact[i].sky_view_factor, 2);
      ambient += std::pow(double{walked.ambient_occlusion(row, column)} - exact[i].ambient_occlusion, 2);
    }
    sky = std::sqrt(sky / static_cast<double>(exact.size()));
    ambient = std::sqrt(ambient / static_cast<double>(exact.size()));
    INFO(shape << ", " << to_string(boundary) << ", fineness " << samples_per_octave << ": A " << sky
               << ", alpha " << ambient);
    // discretisation: samples twice as dense, about first order (measured: a factor of 1.6 to 4.3)
    CHECK(sky < sky_before / 1.5);
    CHECK(ambient < ambient_before / 1.5);
    sky_before = sky;
    ambient_before = ambient;
  }
  CHECK(sky_before < 4e-4);      // measured: 1.1e-4 (brick) to 2.8e-4 (sines, open)
  CHECK(ambient_before < 5e-4);  // measured: 1.5e-4 to 3.1e-4
}

TEST_CASE("the walk finds a flat map open to the last bit", "[visibility][walk]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const int samples_per_octave = GENERATE(8, 32);
  const double level = GENERATE(0.0, 0.7, 1e-20, 4321.987);
  const HorizonSky sky = walk(build_surface(make_map(70, 33, boundary, [&](int, int) { return level; })),
                              {.azimuths = 6, .samples_per_octave = samples_per_octave, .peak_share = 0.3F});
  for (std::size_t i = 0; i < sky.sky_view_factor.size(); ++i) {
    REQUIRE(sky.sky_view_factor.values[i] == 1);
    REQUIRE(sky.ambient_occlusion.values[i] == 1);
  }
}

struct Shortfall {
  double sky = 0;
  double ambient = 0;
};

/// Largest distance from 1 of any receiver on an open plane of that slope along the columns, and half of it
/// along the rows.
Shortfall plane_shortfall(double steepness, int width, int height, const WalkOptions& options) {
  Heightmap map = make_map(width, height, Boundary::open,
                           [&](int row, int column) { return steepness * (column + 0.5 * row); });
  map.spacing = {1, 1};
  const HorizonSky sky = walk(build_surface(std::move(map)), options);
  Shortfall worst;
  for (std::size_t i = 0; i < sky.sky_view_factor.size(); ++i) {
    worst.sky = std::max(worst.sky, std::fabs(1 - double{sky.sky_view_factor.values[i]}));
    worst.ambient = std::max(worst.ambient, std::fabs(1 - double{sky.ambient_occlusion.values[i]}));
  }
  return worst;
}

TEST_CASE("the walk finds an open tilted plane open, also below the horizontal", "[visibility][walk]") {
  const double steepness = GENERATE(0.3, 2.5);  // below and above steep_slope
  // As far as samples lie on the surface itself: rounding, 10⁻⁷ in slopes and sums.
  const Shortfall near =
      plane_shortfall(steepness, 35, 37, {.azimuths = 32, .samples_per_octave = 48, .peak_share = 0.3F});
  CHECK(near.sky < 1e-6);
  CHECK(near.ambient < 3e-6);
  // Farther away, discretisation: the middle of a block lies up to half a block beside the line of sight in
  // both directions, ν blocks or more away, which is 0.75 steepness/ν in slope (and a little for the sample
  // that names the block); α goes with it, A with its square. Before that, lifted samples stand 0.2 × 1.5
  // steepness above the plane, 1.5 ν texels or more away: 0.2 steepness/ν.
  for (const int samples_per_octave : {8, 16, 32}) {
    const double in_slope = steepness / samples_per_octave;
    const Shortfall far = plane_shortfall(
        steepness, 150, 130, {.azimuths = 32, .samples_per_octave = samples_per_octave, .peak_share = 0.3F});
    CHECK(far.ambient < in_slope);
    CHECK(far.sky < in_slope * in_slope);
  }
}

TEST_CASE("few azimuths find a tilted plane as open as many do", "[visibility][walk]") {
  // Where S(m₀) would not sum up to K, it is summed: what is left is 2 e^−10, and rounding.
  const double steepness = GENERATE(0.3, 0.7, 1.0, 1.9);
  for (const int azimuths : {4, 6, 8, 12, 16, 64}) {
    CAPTURE(steepness, azimuths);
    const Shortfall shortfall = plane_shortfall(
        steepness, 35, 37, {.azimuths = azimuths, .samples_per_octave = 48, .peak_share = 0.3F});
    CHECK(shortfall.sky < 1e-4);
  }
}

double largest_difference(const Map& a, const Map& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    worst = std::max(worst, std::fabs(double{a.values[i]} - double{b.values[i]}));
  }
  return worst;
}

TEST_CASE("small relief on a large offset is walked as without it", "[visibility][walk]") {
  constexpr double kDigits = 4096;  // heights of whole 1/4096: the offset costs them nothing
  const Heightmap map = make_map(96, 80, Boundary::tile, [&](int row, int column) {
    const double wave = 0.05 + 0.03 * std::sin(0.2 * row) + 0.02 * std::cos(0.4 * column - 0.1 * row);
    return std::round(wave * kDigits) / kDigits;
  });
  Heightmap raised = map;
  for (float& height : raised.height.values) height += 512;
  const WalkOptions options{.azimuths = 12, .samples_per_octave = 8, .peak_share = 0.3F};
  const HorizonSky low = walk(build_surface(map), options);
  const HorizonSky high = walk(build_surface(raised), options);
  // rounding: the means of blocks are stored to 512 ε = 3e-5, a thousandth of the relief; seen at least ν
  // texels, 0.08, away that is 4e-4 of slope
  CHECK(largest_difference(low.sky_view_factor, high.sky_view_factor) < 2e-4);
  CHECK(largest_difference(low.ambient_occlusion, high.ambient_occlusion) < 4e-4);
  // A base is not even looked at.
  raised = map;
  raised.base = 1e6;
  CHECK(walk(build_surface(raised), options).sky_view_factor == low.sky_view_factor);
}

TEST_CASE("scaling the world changes nothing: by a power of two not one bit", "[visibility][walk]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const auto [factor, tolerance] = GENERATE(
      // 3000: rounding of heights, slopes and sums (measured: 5e-7)
      std::pair{0x1p10, 0.0}, std::pair{0x1p-12, 0.0}, std::pair{3000.0, 3e-6});
  const Heightmap map = make_rough_map(80, 45, boundary, 0.1, 0, 5);
  Heightmap scaled = map;
  for (float& height : scaled.height.values) height = static_cast<float>(double{height} * factor);
  scaled.spacing = {map.spacing.x * factor, map.spacing.y * factor};
  const WalkOptions options{.azimuths = 12, .samples_per_octave = 8, .peak_share = 0.3F};
  const HorizonSky here = walk(build_surface(map), options);
  const HorizonSky there = walk(build_surface(scaled), options);
  CHECK(largest_difference(here.sky_view_factor, there.sky_view_factor) <= tolerance);
  CHECK(largest_difference(here.ambient_occlusion, there.ambient_occlusion) <= tolerance);
}

TEST_CASE("missing samples are NaN in both maps, and the others have a share of sky", "[visibility][walk]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const double relief = GENERATE(0.1, 100.0);
  const Surface surface = build_surface(make_rough_map(67, 71, boundary, relief, 0.3, 2));
  const HorizonSky sky = walk(surface, {.azimuths = 16, .samples_per_octave = 8, .peak_share = 0.3F});
  for (std::size_t i = 0; i < sky.sky_view_factor.size(); ++i) {
    const bool missing = std::isnan(surface.map.height.values[i]);
    REQUIRE(std::isnan(sky.sky_view_factor.values[i]) == missing);
    REQUIRE(std::isnan(sky.ambient_occlusion.values[i]) == missing);
    if (missing) continue;
    REQUIRE(sky.sky_view_factor.values[i] >= 0);
    REQUIRE(sky.sky_view_factor.values[i] <= 1);
    REQUIRE(sky.ambient_occlusion.values[i] >= 0);
    REQUIRE(sky.ambient_occlusion.values[i] <= 1);
  }
}

TEST_CASE("holes occlude nothing, and what they hold means nothing", "[visibility][walk]") {
  // A block of wall amid holes on a plain: the sky is that of the wall alone.
  constexpr int kSize = 65;
  const auto height_at = [](int row, int column) {
    const int away = std::max(std::abs(row - 32), std::abs(column - 32));
    return away < 3 ? 0.2 : away < 6 ? std::nan("") : 0.0;
  };
  const Surface holes = build_surface(make_map(kSize, kSize, Boundary::open, height_at));
  const ExactWalker walker(holes, 64);
  const HorizonSky sky = walk(holes, {.azimuths = 64, .samples_per_octave = 64, .peak_share = 0.3F});
  SliceView view;
  for (int column = 0; column < kSize; column += 2) {
    walker.view(20, column, view);
    if (std::isnan(view.sky_view_factor)) continue;
    // discretisation: the wall's edges, between the samples of a walk
    CHECK(sky.sky_view_factor(20, column) == Approx(view.sky_view_factor).margin(1e-3));
  }
}

}  // namespace
}  // namespace heightlight
