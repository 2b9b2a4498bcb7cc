#include <catch2/catch.hpp>
#include <cmath>

#include "comparison/far_field.h"
#include "heightlight/error.h"
#include "heightlight/screenspace.h"
#include "test_maps.h"

namespace heightlight {
namespace {

constexpr GtaoOptions kPreset{.slices = 3, .steps = 3, .radius = 0.2};

double rms_apart(const Map& a, const Map& b) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a.values[i]) || std::isnan(b.values[i])) continue;
    sum += std::pow(double{a.values[i]} - double{b.values[i]}, 2);
    ++count;
  }
  return std::sqrt(sum / static_cast<double>(count));
}

}  // namespace

TEST_CASE("at half resolution a tilted plane is what it is at the whole", "[screenspace]") {
  const auto [width, height] =
      GENERATE(std::pair{40, 32}, std::pair{41, 33}, std::pair{2, 2}, std::pair{1, 1});
  const Surface surface = build_surface(
      make_map(width, height, Boundary::open, [](int row, int column) { return 0.02 * (column - row); }));
  const DepthBuffer depth = make_depth_buffer(surface);
  const Map half = gtao_half_resolution(depth, kPreset).sky_view_factor;
  const Map whole = gtao(depth, kPreset).sky_view_factor;
  REQUIRE(half.width == width);
  for (std::size_t i = 0; i < half.size(); ++i)
    REQUIRE(half.values[i] ==
            Approx(whole.values[i]).margin(0.02));  // discretisation: steps are twice as long
}

TEST_CASE("at half resolution smooth ground loses next to nothing, and a quarter of the depths is read",
          "[screenspace]") {
  const Surface smooth = build_surface(make_map(128, 128, Boundary::tile, [](int row, int column) {
    return 0.1 * std::sin(column * std::acos(-1) / 32) * std::cos(row * std::acos(-1) / 32);
  }));
  const DepthBuffer depth = make_depth_buffer(smooth);
  GtaoOptions options{
      .slices = 8, .steps = 32, .sampling = DepthSampling::mesh, .noise = DirectionNoise::none};
  options.radius = 0.5;
  const ScreenSpaceView half = gtao_half_resolution(depth, options);
  const ScreenSpaceView whole = gtao(depth, options);
  CHECK(half.samples_per_texel * 4 == whole.samples_per_texel);
  CHECK(rms_apart(half.sky_view_factor, whole.sky_view_factor) < 0.01);
  CHECK(rms_apart(half.ambient_occlusion, whole.ambient_occlusion) < 0.015);
}

TEST_CASE("the upscaling does not mix the two sides of a cliff", "[screenspace]") {
  // The floor beside the cliff is dark, the top is open: plain bilinear weights would darken the top's edge.
  const Surface surface = build_surface(
      make_map(64, 64, Boundary::open, [](int, int column) { return column < 31 ? 0.0 : 1.0; }));
  const DepthBuffer depth = make_depth_buffer(surface);
  GtaoOptions options = kPreset;
  options.noise = DirectionNoise::none;
  options.radius = 0.5;
  const Map half = gtao_half_resolution(depth, options).sky_view_factor;
  for (int row = 8; row < 56; ++row) {
    REQUIRE(half(row, 34) > 0.99F);
    REQUIRE(half(row, 27) < 0.8F);
  }
}

TEST_CASE("missing samples stay missing at half resolution, and hide nothing", "[screenspace]") {
  Heightmap map = make_map(32, 32, Boundary::tile, [](int, int) { return 0.0; });
  for (int column = 8; column < 13; ++column) map.height(10, column) = NAN;
  map.height(20, 20) = NAN;
  const DepthBuffer depth = make_depth_buffer(build_surface(std::move(map)));
  const Map half = gtao_half_resolution(depth, kPreset).sky_view_factor;
  for (int row = 0; row < 32; ++row) {
    for (int column = 0; column < 32; ++column) {
      const bool missing = std::isnan(depth.row_height(row, column));
      REQUIRE(std::isnan(half(row, column)) == missing);
      if (!missing) REQUIRE(half(row, column) == Approx(1).margin(1e-5));
    }
  }
}

TEST_CASE("an accumulation buffer weighs the last turns most, and all of them together as one",
          "[screenspace]") {
  const Surface surface = build_surface(make_synth_map("brick", 64, Boundary::tile, 0.1));
  const DepthBuffer depth = make_depth_buffer(surface);
  GtaoOptions options = kPreset;
  options.noise = DirectionNoise::temporal;
  const auto found = [&](double accumulation) {
    options.accumulation = accumulation;
    return gtao(depth, options).sky_view_factor;
  };
  const Map mean = found(0);
  CHECK(rms_apart(found(1e-6), mean) < 1e-5);
  CHECK(rms_apart(found(0.1), mean) < rms_apart(found(0.5), mean));
  CHECK(rms_apart(found(0.5), mean) < rms_apart(found(1), mean));
  CHECK(rms_apart(found(1), mean) > 1e-3);
  options.accumulation = 1.5;
  CHECK_THROWS_AS(gtao(depth, options), UsageError);
  const DepthBuffer plane =
      make_depth_buffer(build_surface(make_map(16, 16, Boundary::tile, [](int, int) { return 0.0; })));
  options.accumulation = 0.3;
  for (const float sky : gtao(plane, options).sky_view_factor.values) REQUIRE(sky == Approx(1).margin(1e-5));
}

TEST_CASE("SSDO's smooth end only opens, and a hemisphere stays whole", "[screenspace]") {
  const Surface surface = build_surface(make_synth_map("brick", 64, Boundary::tile, 0.1));
  const DepthBuffer depth = make_depth_buffer(surface);
  const SsdoOptions hard{.samples = 16, .noise = DirectionNoise::none, .radius = 0.1};
  SsdoOptions smooth = hard;
  smooth.smooth_end = true;
  const ScreenSpaceView without = ssdo(depth, {{.constant = 0.5}}, hard);
  const ScreenSpaceView with = ssdo(depth, {{.constant = 0.5}}, smooth);
  double opened = 0;
  for (std::size_t i = 0; i < with.sky_view_factor.size(); ++i) {
    REQUIRE(with.sky_view_factor.values[i] >= without.sky_view_factor.values[i] - 1e-5F);
    REQUIRE(with.sky_view_factor.values[i] <= 1 + 1e-5F);
    opened += double{with.sky_view_factor.values[i] - without.sky_view_factor.values[i]};
  }
  CHECK(opened / static_cast<double>(with.sky_view_factor.size()) > 0.002);
}

TEST_CASE("the baked far field is the map's A where it is smooth, and 1 where it has no such level",
          "[comparison]") {
  const Surface smooth = build_surface(make_map(128, 128, Boundary::tile, [](int row, int column) {
    return 0.1 * std::sin(column * std::acos(-1) / 64) * std::cos(row * std::acos(-1) / 64);
  }));
  const Map far = bake_far_field(smooth, ~0ULL);
  const Surface tiny = build_surface(make_synth_map("sines", 8, Boundary::tile, 0.3));
  for (const float sky : bake_far_field(tiny, ~0ULL).values) CHECK(sky == 1);
  const DepthBuffer depth = make_depth_buffer(smooth);
  GtaoOptions converged{
      .slices = 32, .steps = 128, .sampling = DepthSampling::mesh, .noise = DirectionNoise::none};
  converged.divide_by_open = true;
  CHECK(rms_apart(far, gtao(depth, converged).sky_view_factor) < 0.02);  // discretisation: 16 × 16 samples
}

}  // namespace heightlight
