#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "heightlight/forms.h"
#include "heightlight/screenspace.h"
#include "screenspace/gtao_bounce_kernel.h"
#include "test_maps.h"
#include "transport/exact_gather.h"
#include "visibility/walked_tiles.h"

namespace heightlight {
namespace {

TEST_CASE("the bounce's lanes and its scalar twin agree on every instruction set", "[screenspace]") {
  const auto [width, height] = GENERATE(std::pair{67, 13}, std::pair{1, 1}, std::pair{5, 3});
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const DepthSampling sampling = GENERATE(DepthSampling::nearest, DepthSampling::mesh);
  const Surface surface = build_surface(make_rough_map(width, height, boundary, 0.1, 0.1, 3));
  const DepthBuffer depth = make_depth_buffer(surface);
  const SliceTables tables = make_slice_tables(depth,
                                               {.slices = 2,
                                                .steps = 9,
                                                .distribution = StepDistribution::stratified,
                                                .sampling = sampling,
                                                .noise = DirectionNoise::spatial,
                                                .radius = 0.3},
                                               0);
  std::vector<float> radiance(depth.heights.size());
  for (int row = 0; row < depth.period_rows; ++row) {
    for (int column = 0; column < depth.stride * DepthBuffer::kPhases; ++column) {  // on around the torus
      const int place = row * depth.period_columns + column % depth.period_columns;
      radiance[depth.index(row, column)] =
          static_cast<float>(unit_real(scramble(static_cast<std::uint64_t>(place))));
    }
  }
  for (int row = 0; row < height; ++row) {
    const std::vector<float> none(static_cast<std::size_t>(width));
    SeenSums twin{none, none};
    gather_slices_scalar({depth, tables, radiance}, row, twin);
    for (const std::int64_t target : instruction_sets()) {
      const InstructionSet use(target);
      SeenSums lanes{none, none};
      gather_slices({depth, tables, radiance}, row, lanes);
      for (int column = 0; column < width; ++column) {
        if (std::isnan(surface.map.height(row, column))) continue;
        const auto j = static_cast<std::size_t>(column);
        INFO(hwy::TargetName(target) << ", " << row << ", " << column);
        REQUIRE(lanes.hidden[j] == Approx(twin.hidden[j]).epsilon(0).margin(1e-5));  // rounding
        REQUIRE(lanes.light[j] == Approx(twin.light[j]).epsilon(0).margin(1e-5));
      }
    }
  }
}

GtaoOptions fine_options() {
  GtaoOptions options;
  options.slices = 32;
  options.steps = 256;
  options.sampling = DepthSampling::mesh;
  options.noise = DirectionNoise::none;
  options.divide_by_open = true;
  return options;
}

TEST_CASE("the bounce gathers what exact walks gather", "[screenspace]") {
  const Surface surface = build_surface(make_synth_map("fbm", 48, Boundary::tile, 0.2));
  const ScreenSpaceView view = gtao_with_bounce(make_depth_buffer(surface), fine_options());
  const auto sky = [&](std::size_t texel) { return double{view.sky_view_factor.values[texel]}; };
  const ExactWalker walker(surface, 128);
  double squares = 0;
  double exact_sum = 0;
  for (int row = 0; row < 48; row += 4) {
    SliceView exact;
    for (int column = 0; column < 48; ++column) {
      walker.view(row, column, exact);
      const double first = gather_exactly(exact, surface, sky);
      const double found = (1 - double{view.sky_view_factor(row, column)}) * double{view.seen(row, column)};
      squares += (found - first) * (found - first);
      exact_sum += first;
    }
  }
  CHECK(exact_sum / 576 > 0.08);  // there is something to gather
  // discretisation: a stretch between two samples sends the mean of its ends
  CHECK(std::sqrt(squares / 576) < 2e-3);
}

TEST_CASE("in a spherical pit everything seen is as dark as the place that sees it", "[screenspace]") {
  // Depth R/2: every point of the pit has A = 1 − f with f = depth/(2 R) = 1/4, and sees nothing but the pit.
  constexpr int kSize = 96;
  constexpr double kRadius = 0.4;
  constexpr double kRim = 0.34641016151377546;  // R √(1 − ¼)
  const Surface surface = build_surface(make_map(kSize, kSize, Boundary::open, [&](int row, int column) {
    const double x = (column + 0.5) / kSize - 0.5;
    const double y = (row + 0.5) / kSize - 0.5;
    const double squared = x * x + y * y;
    return squared < kRim * kRim ? kRadius / 2 - std::sqrt(kRadius * kRadius - squared) : 0.0;
  }));
  const ScreenSpaceView view = gtao_with_bounce(make_depth_buffer(surface), fine_options());
  for (int row = 30; row < 66; row += 5) {
    for (int column = 30; column < 66; column += 5) {
      // discretisation: facets for a sphere, and a rim of whole texels
      CHECK(view.sky_view_factor(row, column) == Approx(0.75).margin(0.015));
      CHECK(view.seen(row, column) == Approx(0.75).margin(0.02));
      const double sky = double{view.sky_view_factor(row, column)};
      const double total = bounced_total(SkyViewFactor<double>(sky),
                                         SeenSkyViewFactor<double>(double{view.seen(row, column)}), 0.8);
      CHECK(total == Approx(0.75 / (1 - 0.8 * 0.25)).margin(0.015));  // Σ (1 − f) (ρ f)^b
    }
  }
}

TEST_CASE("what sees nothing but the sky has nothing darker to see", "[screenspace]") {
  const Surface surface = build_surface(make_map(20, 20, Boundary::tile, [](int, int) { return 0.5; }));
  const ScreenSpaceView view = gtao_with_bounce(make_depth_buffer(surface), {});
  for (const float seen : view.seen.values) REQUIRE(seen == 1.0F);
}

}  // namespace
}  // namespace heightlight
