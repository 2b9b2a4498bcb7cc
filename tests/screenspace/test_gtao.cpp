#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/parallel.h"
#include "base/texel_algebra.h"
#include "heightlight/error.h"
#include "heightlight/screenspace.h"
#include "published_gtao.h"
#include "screenspace/gtao_kernel.h"
#include "test_maps.h"
#include "visibility/exact_walk.h"
#include "visibility/walked_tiles.h"

namespace heightlight {
namespace {

using GtaoRow = void (*)(const GtaoPass&, int, GtaoSums&);

/// The sums of all rows, one after the other.
std::vector<GtaoSums> sum_rows(GtaoRow kernel, const GtaoPass& pass) {
  std::vector<GtaoSums> rows(static_cast<std::size_t>(pass.depth.height));
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const auto width = static_cast<std::size_t>(pass.depth.width);
    rows[row] = {std::vector<float>(width),
                 std::vector<float>(width),
                 std::vector<float>(width),
                 {std::vector<float>(width), std::vector<float>(width), std::vector<float>(width)}};
    kernel(pass, static_cast<int>(row), rows[row]);
  }
  return rows;
}

double largest_difference(const std::vector<float>& a, const std::vector<float>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    worst = std::max(worst, std::fabs(double{a[i]} - double{b[i]}));
  }
  return worst;
}

double root_mean_square(const Map& map, const Map& reference) {
  double squares = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (std::isnan(reference.values[i])) continue;
    squares += std::pow(double{map.values[i]} - double{reference.values[i]}, 2);
    ++count;
  }
  return std::sqrt(squares / static_cast<double>(count));
}

bool same(const Map& a, const Map& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a.values[i] != b.values[i] && !(std::isnan(a.values[i]) && std::isnan(b.values[i]))) return false;
  }
  return a.size() == b.size();
}

TEST_CASE("GTAO's lanes and its scalar twin agree on every instruction set", "[screenspace]") {
  const auto [width, height] =
      GENERATE(std::pair{67, 21}, std::pair{1, 1}, std::pair{5, 3}, std::pair{160, 4});
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const DepthSampling sampling = GENERATE(DepthSampling::nearest, DepthSampling::mesh);
  const bool attenuated = GENERATE(false, true);
  const Surface surface = build_surface(make_rough_map(width, height, boundary, 0.1, 0.1, 3));
  const DepthBuffer depth = make_depth_buffer(surface);
  const SliceTables tables = make_slice_tables(depth,
                                               {.slices = 3,
                                                .steps = 7,
                                                .distribution = StepDistribution::stratified,
                                                .sampling = sampling,
                                                .noise = DirectionNoise::temporal,
                                                .radius = 0.3},
                                               2);
  GtaoPass pass{depth, tables};
  if (attenuated) {
    pass.attenuated = true;
    pass.radius = 0.3F;
    pass.per_falloff = 5;
    pass.thickness = 0.02F;
  }
  const std::vector<GtaoSums> twin = sum_rows(gtao_row_scalar, pass);
  for (const std::int64_t target : instruction_sets()) {
    const InstructionSet use(target);
    const std::vector<GtaoSums> lanes = sum_rows(gtao_row, pass);
    INFO(width << " × " << height << ", " << to_string(boundary) << ", " << hwy::TargetName(target));
    double worst = 0;
    for (std::size_t row = 0; row < lanes.size(); ++row) {
      for (int column = 0; column < width; ++column) {
        if (!std::isnan(surface.map.height(static_cast<int>(row), column))) continue;
        for (const std::vector<GtaoSums>* rows : {&lanes, &twin}) {  // missing receivers hold no answer
          auto& sums = const_cast<GtaoSums&>((*rows)[row]);
          for (auto* part : {&sums.sky, &sums.open, &sums.solid, &sums.bent[0], &sums.bent[1], &sums.bent[2]})
            (*part)[static_cast<std::size_t>(column)] = 0;
        }
      }
      worst = std::max(worst, largest_difference(lanes[row].sky, twin[row].sky));
      worst = std::max(worst, largest_difference(lanes[row].open, twin[row].open));
      worst = std::max(worst, largest_difference(lanes[row].solid, twin[row].solid));
      for (std::size_t i = 0; i < 3; ++i) {
        worst = std::max(worst, largest_difference(lanes[row].bent[i], twin[row].bent[i]));
      }
    }
    CHECK(worst < 1e-5);  // rounding: sums of six sides of order 1, slopes of heights a texel apart
  }
}

TEST_CASE("GTAO is what algorithm 1 says, line by line", "[screenspace]") {
  constexpr int kSlices = 4;
  constexpr int kSteps = 6;
  constexpr double kRadius = 0.4;
  const Surface surface = build_surface(make_rough_map(24, 20, Boundary::tile, 0.3, 0, 5));
  GtaoOptions options{.slices = kSlices, .steps = kSteps};
  options.noise = DirectionNoise::none;
  options.radius = kRadius;
  options.bent_normal = true;
  const ScreenSpaceView view = gtao(make_depth_buffer(surface), options);
  const auto wrapped = [](int i, int count) { return ((i % count) + count) % count; };
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 24; ++column) {
      const Eigen::Vector3d normal = as_eigen(surface.normal(row, column)).cast<double>();
      double visibility = 0;
      Eigen::Vector3d bent = Eigen::Vector3d::Zero();
      for (int slice = 0; slice < kSlices; ++slice) {
        const double azimuth = std::numbers::pi * (slice + 0.25) / kSlices;
        const ProjectedNormal projected = project_normal(normal, azimuth);
        double theta[2];
        for (int side = 0; side < 2; ++side) {
          const double sign = side == 0 ? -1 : 1;
          double cosine = -1;
          for (int k = 1; k <= kSteps; ++k) {
            const double way = kRadius * k * k / (kSteps * kSteps);
            double u = sign * way * std::cos(azimuth) * 24;
            double v = -sign * way * std::sin(azimuth) * 24;
            const double larger = std::max(std::fabs(u), std::fabs(v));
            if (larger < 1) u /= larger, v /= larger;
            const int right = static_cast<int>(std::lround(u));
            const int down = static_cast<int>(std::lround(v));
            const double rise =
                double{surface.map.height(wrapped(row + down, 20), wrapped(column + right, 24))} -
                double{surface.map.height(row, column)};
            cosine = std::max(cosine, rise / std::hypot(right / 24.0, down / 24.0, rise));
          }
          theta[side] = clamp_to_hemisphere(sign * std::acos(cosine), projected.gamma);
        }
        visibility += projected.length * inner_integral(theta[0], theta[1], projected.gamma) / kSlices;
        const Eigen::Vector2d part = projected.length * bent_integral(theta[0], theta[1], projected.gamma);
        bent += Eigen::Vector3d(std::cos(azimuth) * part.x(), std::sin(azimuth) * part.x(), part.y());
      }
      REQUIRE(double{view.sky_view_factor(row, column)} == Approx(std::min(visibility, 1.0)).margin(3e-6));
      REQUIRE((as_eigen(view.bent_normal(row, column)).cast<double>() - bent.normalized()).norm() <
              2e-5);  // rounding
    }
  }
}

TEST_CASE("a flat plane is open: exactly 1, whatever GTAO's options", "[screenspace]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const DepthSampling sampling = GENERATE(DepthSampling::nearest, DepthSampling::mesh);
  const DirectionNoise noise =
      GENERATE(DirectionNoise::none, DirectionNoise::spatial, DirectionNoise::temporal);
  const Surface surface = build_surface(make_map(33, 18, boundary, [](int, int) { return 0.25; }));
  GtaoOptions options{.slices = 2, .steps = 5};
  options.sampling = sampling;
  options.noise = noise;
  options.falloff = GENERATE(0.0, 0.5);
  options.radius = 0.4;
  options.divide_by_open = GENERATE(false, true);
  options.bent_normal = true;
  const ScreenSpaceView view = gtao(make_depth_buffer(surface), options);
  for (std::size_t i = 0; i < view.sky_view_factor.size(); ++i) {
    REQUIRE(std::fabs(view.sky_view_factor.values[i] - 1) <= 2.4e-7F);  // identity: two roundings of 1
    REQUIRE((as_eigen(view.bent_normal.values[i]) - Eigen::Vector3f::UnitZ()).norm() < 1e-6F);
  }
}

TEST_CASE("a tilted plane is open: 1 once the slices' own sum is divided by", "[screenspace]") {
  const double slope = GENERATE(0.5, 2.0);
  const Surface surface = build_surface(make_map(
      40, 40, Boundary::open, [&](int row, int column) { return slope * (column - 0.5 * row) / 40; }));
  GtaoOptions options{.slices = 3, .steps = 8};
  options.noise = DirectionNoise::none;
  options.divide_by_open = true;
  options.sampling = DepthSampling::mesh;
  const ScreenSpaceView view = gtao(make_depth_buffer(surface), options);
  for (const float sky : view.sky_view_factor.values) REQUIRE(sky == Approx(1).margin(3e-6));  // rounding
}

TEST_CASE("GTAO tells the same for any number of threads, and for a map moved around its torus",
          "[screenspace]") {
  const Heightmap map = make_rough_map(44, 36, Boundary::tile, 0.2, 0.05, 7);
  GtaoOptions options{.slices = 2, .steps = 6};
  options.distribution = StepDistribution::stratified;
  options.noise = DirectionNoise::temporal;
  options.radius = 0.5;
  const auto run = [&](const Heightmap& heights) {
    return gtao(make_depth_buffer(build_surface(heights)), options).sky_view_factor;
  };
  const auto run_on = [&](int threads) {
    const ThreadScope scope(threads);
    return run(map);
  };
  const Map one = run_on(1);
  CHECK(same(run_on(7), one));
  Heightmap moved_one = map;
  moved_one.height = one;
  CHECK(same(run(shift_map(map, 8, 12)), shift_map(moved_one, 8, 12).height));  // the noise's period is 4
}

TEST_CASE("with slices and steps GTAO converges to the exact walk", "[screenspace][slow]") {
  const auto [shape, boundary] =
      GENERATE(std::pair{"brick", Boundary::tile}, std::pair{"fbm", Boundary::open});
  const Surface surface = build_surface(make_synth_map(shape, 64, boundary, 0.1));
  const DepthBuffer depth = make_depth_buffer(surface);
  Map reference(64, 64);
  Image<Vector3> bent(64, 64);
  const ExactWalker walker(surface, 512);
  parallel_for(64, [&](std::int64_t row) {
    SliceView view;
    for (int column = 0; column < 64; ++column) {
      walker.view(static_cast<int>(row), column, view);
      reference(static_cast<int>(row), column) = static_cast<float>(view.sky_view_factor);
      bent(static_cast<int>(row), column) = to_vector3(view.bent_normal.cast<float>());
    }
  });
  double before = 1;
  for (const int slices : {4, 16, 64}) {
    GtaoOptions options{.slices = slices, .steps = 16 * slices};
    options.sampling = DepthSampling::mesh;
    options.noise = DirectionNoise::none;
    options.bent_normal = true;
    const ScreenSpaceView view = gtao(depth, options);
    const double error = root_mean_square(view.sky_view_factor, reference);
    INFO(shape << ", " << to_string(boundary) << ", " << slices << " slices: " << error);
    CHECK(error < 0.6 * before);  // discretisation: both at least of first order, four times as many
    before = error;
    if (slices < 64) continue;
    CHECK(error < 1e-3);
    double squares = 0;
    for (std::size_t i = 0; i < bent.size(); ++i) {
      const double cosine = double{as_eigen(view.bent_normal.values[i]).dot(as_eigen(bent.values[i]))};
      squares += std::pow(std::acos(std::clamp(cosine, -1.0, 1.0)), 2);
    }
    CHECK(std::sqrt(squares / 4096) * 180 / std::numbers::pi < 0.5);
  }
}

TEST_CASE("missing samples have no answer and hide nothing", "[screenspace]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Surface surface = build_surface(make_map(
      32, 32, Boundary::open, [&](int row, int column) { return row == 16 || column == 3 ? nan : 0.0; }));
  GtaoOptions options{.slices = 4, .steps = 8};
  options.noise = GENERATE(DirectionNoise::none, DirectionNoise::spatial);
  options.thickness = GENERATE(0.0, 0.1);
  const Map sky = gtao(make_depth_buffer(surface), options).sky_view_factor;
  for (int row = 0; row < 32; ++row) {
    for (int column = 0; column < 32; ++column) {
      const bool missing = row == 16 || column == 3;
      REQUIRE(std::isnan(sky(row, column)) == missing);
      if (!missing) REQUIRE(sky(row, column) == Approx(1).margin(3e-7));  // identity
    }
  }
}

TEST_CASE("equation 13's thickness only ever opens a height field", "[screenspace]") {
  const Surface surface = build_surface(make_synth_map("brick", 96, Boundary::tile, 0.1));
  const DepthBuffer depth = make_depth_buffer(surface);
  GtaoOptions options{.slices = 4, .steps = 32};
  options.noise = DirectionNoise::none;
  const Map without = gtao(depth, options).sky_view_factor;
  options.thickness = 1e-9;  // followed, but too thin to show
  const Map barely = gtao(depth, options).sky_view_factor;
  CHECK(root_mean_square(barely, without) < 1e-5);  // rounding of cosines beside slopes
  double before = 0;
  for (const double thickness : {0.005, 0.02, 0.1}) {
    options.thickness = thickness;
    const Map with = gtao(depth, options).sky_view_factor;
    double opened = 0;
    for (std::size_t i = 0; i < with.size(); ++i) {
      REQUIRE(with.values[i] >= without.values[i] - 1e-5F);
      opened += double{with.values[i]} - double{without.values[i]};
    }
    CHECK(opened > before);
    before = opened;
  }
}

TEST_CASE("GTAO refuses options outside their range", "[screenspace]") {
  const DepthBuffer depth =
      make_depth_buffer(build_surface(make_map(4, 4, Boundary::tile, [](int, int) { return 0.0; })));
  GtaoOptions options;
  SECTION("no slices") { options.slices = 0; }
  SECTION("no steps") { options.steps = 0; }
  SECTION("no reach") { options.radius = 0; }
  SECTION("a falloff beyond the reach") { options.falloff = 1.5; }
  SECTION("less than no thickness") { options.thickness = -1; }
  CHECK_THROWS_AS(gtao(depth, options), UsageError);
}

}  // namespace
}  // namespace heightlight
