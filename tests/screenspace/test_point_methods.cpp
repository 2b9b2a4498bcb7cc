#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "heightlight/error.h"
#include "heightlight/screenspace.h"
#include "screenspace/point_kernel.h"
#include "screenspace/relaxed_points.h"
#include "test_maps.h"
#include "visibility/walked_tiles.h"

// The methods that test points of the tangent hemisphere: ambient transfer and SSDO.

namespace heightlight {
namespace {

Surface rough_surface(int width, int height, Boundary boundary) {
  return build_surface(make_rough_map(width, height, boundary, 0.1, 0.1, 3));
}

std::vector<TangentPoint> some_points(float radius) {
  std::vector<TangentPoint> points;
  for (const Eigen::Vector3d& xi : relaxed_points(12)) {
    const Eigen::Vector3d way = radius * (xi - Eigen::Vector3d(0.5, 0.5, 0.05));
    points.push_back(
        {static_cast<float>(way.x()), static_cast<float>(way.y()), static_cast<float>(way.z()), 0.1F, 0.02F});
  }
  return points;
}

Map random_map(int width, int height) {
  Map map(width, height);
  for (std::size_t i = 0; i < map.size(); ++i) map.values[i] = static_cast<float>(unit_real(scramble(i)));
  return map;
}

/// Receivers whose sums differ by more than rounding: a point on the surface may fall on either side of it.
int count_differences(const std::vector<float>& a, const std::vector<float>& b, const Surface& surface,
                      int row) {
  int count = 0;
  for (int column = 0; column < surface.width(); ++column) {
    const auto at = static_cast<std::size_t>(column);
    count += !std::isnan(surface.map.height(row, column)) && !(std::fabs(a[at] - b[at]) < 1e-5F);
  }
  return count;
}

TEST_CASE("the point tests' lanes and their scalar twin agree on every instruction set", "[screenspace]") {
  const auto [width, height] = GENERATE(std::pair{67, 12}, std::pair{1, 1}, std::pair{5, 3});
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const int tests = GENERATE(1, 3);
  const Surface surface = rough_surface(width, height, boundary);
  const DepthBuffer depth = make_depth_buffer(surface);
  const std::vector<TangentPoint> points = some_points(0.4F);
  const Map albedo = random_map(width, height);
  const Map sender = random_map(width, height);
  PointPass pass{depth, points, tests, 1e-5F};
  set_turns(DirectionNoise::spatial, 0, pass);
  pass.albedos = {&albedo};
  const SkyGrid sky = make_sky_grid(two_tone_sky(), 0.1);
  pass.sky = &sky;
  const BouncePass bounce{pass, sender, 0.01F, 0.02F};
  const auto no_sums = [width = width] {  // Clang 14 captures no bindings
    const std::vector<float> none(static_cast<std::size_t>(width));
    return PointSums{none, {none, none, none}, {none}};
  };
  for (const std::int64_t target : instruction_sets()) {
    const InstructionSet use(target);
    int differences = 0;
    for (int row = 0; row < height; ++row) {
      PointSums twin = no_sums();
      PointSums lanes = no_sums();
      test_points_scalar(pass, row, twin);
      test_points(pass, row, lanes);
      differences += count_differences(twin.open, lanes.open, surface, row);
      for (std::size_t c = 0; c < 3; ++c)
        differences += count_differences(twin.sky[c], lanes.sky[c], surface, row);
      differences += count_differences(twin.albedo[0], lanes.albedo[0], surface, row);
      bounce_points_scalar(bounce, row, twin.open);
      bounce_points(bounce, row, lanes.open);
      differences += count_differences(twin.open, lanes.open, surface, row);
    }
    INFO(hwy::TargetName(target) << ", " << width << " × " << height << ", " << to_string(boundary));
    CHECK(differences <= width * height / 100);  // rounding: ties of a point with the surface
  }
}

TEST_CASE("relaxed points are farther apart than random ones, and as many everywhere", "[screenspace]") {
  const int count = GENERATE(8, 16, 64);
  const std::vector<Eigen::Vector3d>& points = relaxed_points(count);
  REQUIRE(points.size() == static_cast<std::size_t>(count));
  double least = 1;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    CHECK((points[i].minCoeff() >= 0 && points[i].maxCoeff() <= 1));
    sum += points[i];
    for (std::size_t j = 0; j < i; ++j) {
      Eigen::Vector3d way = points[i] - points[j];
      way.x() -= std::round(way.x());
      least = std::min(least, way.norm());
    }
  }
  // Cubes of volume 1/n are n^(−1/3) apart; relaxed points keep well over a half of that, random ones hardly
  // a tenth.
  CHECK(least > 0.55 / std::cbrt(count));
  CHECK(sum.y() / count == Approx(0.5).margin(0.02));  // discretisation
  CHECK(sum.z() / count == Approx(0.5).margin(0.02));
}

TEST_CASE("a plane is open to ambient transfer and to SSDO: exactly 1", "[screenspace]") {
  const double slope = GENERATE(0.0, 0.8);
  const Surface surface = build_surface(
      make_map(40, 32, Boundary::open, [&](int row, int column) { return slope * (column - row) / 40; }));
  const DepthBuffer depth = make_depth_buffer(surface);
  const std::vector<SurfaceAlbedo> albedos{{.constant = 0.5}};
  const ScreenSpaceView transfer = ambient_transfer(
      depth, albedos,
      {.samples = 16,
       .tests = 2,
       .measure = GENERATE(FuzzyMeasure::step, FuzzyMeasure::root, FuzzyMeasure::exponential)});
  const ScreenSpaceView directional = ssdo(depth, albedos, {.samples = 16});
  for (std::size_t i = 0; i < depth.row_height.size(); ++i) {
    REQUIRE(transfer.sky_view_factor.values[i] == Approx(1).margin(1e-6));  // identity, sixteen roundings
    REQUIRE(transfer.totals[0].values[i] == Approx(1).margin(1e-6));
    REQUIRE(directional.sky_view_factor.values[i] == Approx(1).margin(1e-6));
    REQUIRE(directional.totals[0].values[i] == Approx(1).margin(1e-6));
  }
}

TEST_CASE("with one albedo the ambient transfer is equation 12 of its obscurance, given as a map or not",
          "[screenspace]") {
  const Surface surface = build_surface(make_synth_map("brick", 64, Boundary::tile, 0.1));
  const DepthBuffer depth = make_depth_buffer(surface);
  const Map grey(64, 64, 0.7F);
  const ScreenSpaceView view = ambient_transfer(depth, {{.constant = 0.7}, {.constant = 0, .map = &grey}},
                                                {.samples = 16, .tests = 2, .measure = FuzzyMeasure::root});
  double deepest = 1;
  for (std::size_t i = 0; i < grey.size(); ++i) {
    const double open = double{view.sky_view_factor.values[i]};
    deepest = std::min(deepest, open);
    const double expected = open / (1 - 0.7 * (1 - open));
    REQUIRE(double{view.totals[0].values[i]} == Approx(expected).margin(2e-6));  // rounding
    REQUIRE(double{view.totals[1].values[i]} == Approx(expected).margin(2e-6));
  }
  CHECK(deepest < 0.8);
}

TEST_CASE("many tests on the way find what one misses: a thin wall", "[screenspace]") {
  // A receiver of the floor beside walls one texel thick.
  const Surface surface = build_surface(
      make_map(64, 64, Boundary::tile, [](int, int column) { return column % 16 == 8 ? 0.3 : 0.0; }));
  const DepthBuffer depth = make_depth_buffer(surface);
  const auto mean = [&](int tests) {
    const Map open = ambient_transfer(depth, {},
                                      {.samples = 64,
                                       .tests = tests,
                                       .measure = FuzzyMeasure::step,
                                       .noise = DirectionNoise::none,
                                       .radius = 0.3})
                         .sky_view_factor;
    double sum = 0;
    for (int column = 0; column < 64; ++column) {
      if (column % 16 < 6 || column % 16 > 10) sum += double{open(30, column)};
    }
    return sum;
  };
  CHECK(mean(2) < mean(1));
  CHECK(mean(32) < mean(2));
}

TEST_CASE("under an even sky SSDO finds what it takes for A, with a smooth end too", "[screenspace]") {
  const DepthBuffer depth = make_depth_buffer(rough_surface(40, 37, Boundary::tile));
  const SsdoOptions options{.samples = 16, .radius = 0.3, .smooth_end = GENERATE(false, true)};
  const SkyGrid even = make_sky_grid({Image<Vector3>(2, 1, Vector3{2, 1, 0})}, ssdo_solid_angle(options));
  const Image<Vector3> light = ssdo_under_sky(depth, even, options);
  const Map open = ssdo(depth, {}, options).sky_view_factor;
  for (std::size_t i = 0; i < light.size(); ++i) {
    REQUIRE(std::isnan(light.values[i].x) == std::isnan(open.values[i]));
    if (std::isnan(open.values[i])) continue;
    REQUIRE(light.values[i].x == Approx(2 * open.values[i]).margin(1e-5));  // rounding
    REQUIRE(light.values[i].y == Approx(open.values[i]).margin(1e-5));
    REQUIRE(light.values[i].z == 0);
  }
}

TEST_CASE("SSDO sees which half of the sky a wall hides", "[screenspace]") {
  // A wall that runs along x: texels below it in the image look up (+y) at it.
  const Surface surface =
      build_surface(make_map(48, 48, Boundary::open, [](int row, int) { return row < 20 ? 0.4 : 0.0; }));
  const SsdoOptions options{.samples = 64, .noise = DirectionNoise::spatial, .radius = 0.5};
  const DepthBuffer depth = make_depth_buffer(surface);
  const ScreenSpaceView view = ssdo(depth, {{.constant = 0.5}}, options);
  // Red from y > 0, green from the rest.
  SkyLight halves{Image<Vector3>(4, 2, {0, 1, 0})};
  for (int row = 0; row < 2; ++row) halves.radiance(row, 1) = halves.radiance(row, 2) = {1, 0, 0};
  const Image<Vector3> light =
      ssdo_under_sky(depth, make_sky_grid(halves, ssdo_solid_angle(options)), options);
  const float whole = view.sky_view_factor(26, 24);
  const float upper = light(26, 24).x;
  CHECK(light(26, 24).x + light(26, 24).y == Approx(whole).margin(1e-5));
  CHECK(whole < 0.9F);
  CHECK(upper < 0.4F);
  CHECK(whole - upper > 0.45F);
  CHECK(view.totals[0](26, 24) > whole);  // the wall sends some back
}

TEST_CASE("point methods tell the same for any number of threads", "[screenspace]") {
  const DepthBuffer depth = make_depth_buffer(rough_surface(40, 37, Boundary::tile));
  const auto run = [&] {
    ScreenSpaceView view =
        ssdo(depth, {{.constant = 0.5}}, {.samples = 8, .noise = DirectionNoise::temporal, .radius = 0.3});
    std::vector<float> all = view.sky_view_factor.values;
    all.insert(all.end(), view.totals[0].values.begin(), view.totals[0].values.end());
    const ScreenSpaceView other = ambient_transfer(depth, {{.constant = 0.5}}, {.samples = 8});
    all.insert(all.end(), other.totals[0].values.begin(), other.totals[0].values.end());
    for (float& value : all) {
      if (std::isnan(value)) value = -1;
    }
    return all;
  };
  const auto run_on = [&](int threads) {
    const ThreadScope scope(threads);
    return run();
  };
  const std::vector<float> one = run_on(1);
  CHECK(run_on(5) == one);
}

TEST_CASE("point methods refuse options outside their range", "[screenspace]") {
  const DepthBuffer depth = make_depth_buffer(rough_surface(4, 4, Boundary::tile));
  CHECK_THROWS_AS(ambient_transfer(depth, {}, {.samples = 0}), UsageError);
  CHECK_THROWS_AS(ambient_transfer(depth, {}, {.samples = 4, .tests = 0}), UsageError);
  const AmbientTransferOptions no_reach{
      .samples = 4, .tests = 1, .measure = FuzzyMeasure::root, .noise = DirectionNoise::none, .radius = 0};
  CHECK_THROWS_AS(ambient_transfer(depth, {}, no_reach), UsageError);
  CHECK_THROWS_AS(ssdo(depth, {}, {.samples = 0}), UsageError);
  CHECK_THROWS_AS(ssdo(depth, {}, {.samples = 4, .noise = DirectionNoise::none, .radius = -1}), UsageError);
}

}  // namespace
}  // namespace heightlight
