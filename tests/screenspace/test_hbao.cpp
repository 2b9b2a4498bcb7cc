#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "heightlight/error.h"
#include "heightlight/screenspace.h"
#include "screenspace/hbao_kernel.h"
#include "test_maps.h"
#include "visibility/exact_walk.h"
#include "visibility/walked_tiles.h"

namespace heightlight {
namespace {

TEST_CASE("HBAO's lanes and its scalar twin agree on every instruction set", "[screenspace]") {
  const auto [width, height] = GENERATE(std::pair{67, 21}, std::pair{1, 1}, std::pair{5, 3});
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const DepthSampling sampling = GENERATE(DepthSampling::nearest, DepthSampling::mesh);
  const float per_squared_radius = GENERATE(0.0F, 20.0F);
  const Surface surface = build_surface(make_rough_map(width, height, boundary, 0.1, 0.1, 3));
  const DepthBuffer depth = make_depth_buffer(surface);
  const SliceTables tables = make_slice_tables(depth,
                                               {.slices = 3,
                                                .steps = 7,
                                                .distribution = StepDistribution::stratified,
                                                .sampling = sampling,
                                                .noise = DirectionNoise::spatial,
                                                .radius = 0.3},
                                               0);
  const HbaoPass pass{depth, tables, per_squared_radius};
  for (int row = 0; row < height; ++row) {
    std::vector<float> twin(static_cast<std::size_t>(width));
    hbao_row_scalar(pass, row, twin);
    for (const std::int64_t target : instruction_sets()) {
      const InstructionSet use(target);
      std::vector<float> lanes(static_cast<std::size_t>(width));
      hbao_row(pass, row, lanes);
      for (int column = 0; column < width; ++column) {
        if (std::isnan(surface.map.height(row, column))) continue;
        INFO(hwy::TargetName(target) << ", " << row << ", " << column);
        const auto at = static_cast<std::size_t>(column);
        REQUIRE(lanes[at] == Approx(twin[at]).epsilon(0).margin(1e-5));  // rounding: six sides of order 1
      }
    }
  }
}

TEST_CASE("without attenuation HBAO converges to the plain solid angle, not to the cosine-weighted share",
          "[screenspace]") {
  const Surface surface = build_surface(make_synth_map("brick", 64, Boundary::tile, 0.1));
  HbaoOptions options;
  options.slices = 64;
  options.steps = 256;
  options.distribution = StepDistribution::quadratic;
  options.sampling = DepthSampling::mesh;
  options.noise = DirectionNoise::none;
  options.attenuated = false;
  const Map open = hbao(make_depth_buffer(surface), options).ambient_occlusion;
  const ExactWalker walker(surface, 256);
  std::vector<double> squares(64);
  std::vector<double> sky_squares(64);
  parallel_for(64, [&](std::int64_t row) {
    SliceView view;
    for (int column = 0; column < 64; ++column) {
      walker.view(static_cast<int>(row), column, view);
      const double found = double{open(static_cast<int>(row), column)};
      squares[static_cast<std::size_t>(row)] += std::pow(found - view.ambient_occlusion, 2);
      sky_squares[static_cast<std::size_t>(row)] += std::pow(found - view.sky_view_factor, 2);
    }
  });
  double sum = 0;
  double sky_sum = 0;
  for (std::size_t row = 0; row < 64; ++row) sum += squares[row], sky_sum += sky_squares[row];
  CHECK(std::sqrt(sum / 4096) < 2e-3);  // discretisation: of steps, and of slices
  CHECK(std::sqrt(sky_sum / 4096) > 0.05);
}

TEST_CASE("a flat plane is open to HBAO, and a tilted one", "[screenspace]") {
  const double slope = GENERATE(0.0, 1.0);
  const Surface surface = build_surface(
      make_map(32, 32, Boundary::open, [&](int row, int column) { return slope * (column + row) / 32; }));
  HbaoOptions options;
  options.attenuated = GENERATE(false, true);
  options.radius = 0.3;
  options.sampling = DepthSampling::mesh;
  for (const float value : hbao(make_depth_buffer(surface), options).sky_view_factor.values) {
    REQUIRE(value == Approx(1).margin(2e-6));  // rounding of slopes
  }
}

TEST_CASE("HBAO refuses options outside their range", "[screenspace]") {
  const DepthBuffer depth =
      make_depth_buffer(build_surface(make_map(4, 4, Boundary::tile, [](int, int) { return 0.0; })));
  HbaoOptions options;
  options.slices = 0;
  CHECK_THROWS_AS(hbao(depth, options), UsageError);
}

}  // namespace
}  // namespace heightlight
