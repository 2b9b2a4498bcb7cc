#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "bake/bent_cone.h"
#include "bake/material.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "base/texel_algebra.h"
#include "heightlight/forms.h"
#include "shared_data.h"
#include "test_maps.h"
#include "visibility/ray_caster.h"
#include "visibility/sky_harmonics.h"

// The baked fields at the default error against rays, which share no code with the walks.

namespace heightlight {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

Material find(const Surface& surface, std::vector<MaterialMap> maps) {
  BakeOptions options;
  options.maps = std::move(maps);
  return find_material(surface, options);
}

/// What rays see of the sky from one receiver.
struct RaySky {
  double sky_view_factor = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Harmonics harmonics{};
};

RaySky cast_sky(const RayCaster& caster, const Surface& surface, int row, int column) {
  RayWorkspace workspace(caster.rays());
  ReceiverView view;
  caster.view(row, column, workspace, view);
  caster.aim_directions(row, column, caster.directions().turn(row, column), workspace);
  RaySky sky;
  std::size_t hit = 0;
  for (int k = 0; k < view.rays; ++k) {
    if (hit < view.ray.size() && view.ray[hit] == k) {
      ++hit;
      continue;
    }
    const auto i = static_cast<std::size_t>(k);
    const Eigen::Vector3d direction =
        Eigen::Vector3d(static_cast<double>(workspace.step_u[i]) * surface.map.spacing.x,
                        -static_cast<double>(workspace.step_v[i]) * surface.map.spacing.y,
                        static_cast<double>(workspace.slope[i]))
            .normalized();
    const double weight = view.weight[k];
    sky.sky_view_factor += weight;
    sky.first += weight * direction;
    const Harmonics y = harmonics_of(direction);
    for (std::size_t c = 0; c < 9; ++c) sky.harmonics[c] += weight * y[c];
  }
  return sky;
}

Surface surface_of(const std::string& name) {
  if (name == "brick" || name == "fbm" || name == "cobbles") {
    return build_surface(make_synth_map(name.c_str(), 256, Boundary::tile, 0.1));
  }
  const auto path = find_shared_data("material/" + name + "_height16.png");
  return build_surface(path ? load_heightmap(*path, {}, std::uint64_t{1} << 32).map
                            : make_synth_map("sines", 64, Boundary::tile, 0.1));
}

TEST_CASE("bent normals and harmonics at the default error against 65536 rays", "[bake][slow]") {
  const std::string name = GENERATE("brick", "fbm", "Ground054");
  constexpr int kReceivers = 192;
  const Surface surface = surface_of(name);
  const Material material = find(surface, {MaterialMap::sh});
  const RayCaster caster(surface, {.rays = 65536, .seed = 7});
  std::vector<double> angles(kReceivers);
  std::vector<double> brighter(kReceivers);
  // A sky of order 2 that is bright on one side, and positive everywhere.
  const Harmonics lobe = harmonics_of(Eigen::Vector3d(0.6, 0.3, 0.74).normalized());
  Harmonics sky{};
  for (std::size_t c = 0; c < 9; ++c) sky[c] = (c == 0 ? 1.0 : c < 4 ? 0.6 : 0.3) * lobe[c];
  parallel_for(kReceivers, [&](std::int64_t i) {
    const std::size_t texel = scramble(static_cast<std::uint64_t>(i)) % surface.map.height.size();
    const int row = static_cast<int>(texel) / surface.width();
    const int column = static_cast<int>(texel) % surface.width();
    const RaySky truth = cast_sky(caster, surface, row, column);
    const SkyMoments& moments = material.results.moments;
    const Eigen::Vector3d ours = as_eigen(moments.first.values[texel]).cast<double>();
    angles[static_cast<std::size_t>(i)] = std::atan2(ours.cross(truth.first).norm(), ours.dot(truth.first));
    std::array<double, 5> second{};
    for (std::size_t k = 0; k < 5; ++k) second[k] = static_cast<double>(moments.second.values[texel][k]);
    const Harmonics found = harmonics_of_moments(
        static_cast<double>(material.results.sky_view_factor.values[texel]), ours, second);
    brighter[static_cast<std::size_t>(i)] = dot(found, sky) - dot(truth.harmonics, sky);
  });
  double angle_squares = 0;
  double squares = 0;
  for (int i = 0; i < kReceivers; ++i) {
    angle_squares += std::pow(angles[static_cast<std::size_t>(i)] * kDegrees, 2);
    squares += std::pow(brighter[static_cast<std::size_t>(i)], 2);
  }
  // Of an open, level place under that sky.
  const double open = dot(harmonics_of_moments(1, {0, 0, 2.0 / 3}, {0, 0, 0.5, 0, 0}), sky);
  const double degrees = std::sqrt(angle_squares / kReceivers);
  const double relative = std::sqrt(squares / kReceivers) / open;
  INFO(name << ": bent normals " << degrees << " degrees, irradiance " << 100 * relative << " %");
  // discretisation: what an RMSE of 0.002 in A leaves, with the rays' own 0.02 degrees
  CHECK(degrees < 0.3);
  CHECK(relative < 0.005);
}

TEST_CASE("at the bottom of a spherical pit both cones reach the rim", "[bake][slow]") {
  // The bowl's rim radius is 0.35 of the width, its depth `relief` × width.
  const double relief = GENERATE(0.1, 0.25);
  const Surface surface = build_surface(make_synth_map("bowl", 256, Boundary::open, relief));
  const Material material = find(surface, {MaterialMap::bent_cone, MaterialMap::ao});
  const std::size_t bottom = surface.map.height.index(128, 128);
  const double rim = std::atan2(0.35, relief - static_cast<double>(surface.map.height.values[bottom]));
  const auto sky = static_cast<double>(material.results.sky_view_factor.values[bottom]);
  // discretisation: the rim is known to a texel, 0.004 of 0.35, and the walk to 0.002 of A
  CHECK(cone_of_openness(sky) == Approx(rim).margin(0.01));
  CHECK(cone_of_spread(sky, material.results.moments.first.values[bottom]) == Approx(rim).margin(0.02));
  CHECK(std::sin(rim) * std::sin(rim) == Approx(sky).margin(0.01));
}

TEST_CASE("the error that is reported is the error that there is", "[bake][slow]") {
  const Surface surface = build_surface(make_synth_map("brick", 128, Boundary::tile, 0.15));
  const Material material =
      find(surface, {MaterialMap::bent_normal, MaterialMap::multibounce, MaterialMap::ao_n});
  const Evidence& evidence = material.results.evidence;
  REQUIRE(evidence.sky_check);
  CHECK(evidence.sky_check->receivers == 256);
  CHECK(evidence.sky_check->sky_view_factor < 0.003);  // 0.002 wanted, of 256 receivers
  REQUIRE(evidence.sky_check->bent_normal_rad);
  CHECK(*evidence.sky_check->bent_normal_rad * kDegrees < 0.4);
  REQUIRE_FALSE(evidence.total_checks.empty());
  CHECK(evidence.total_checks[0].total_rmse < 0.003);
  for (const ModelError& error : material.model_errors) {
    INFO("albedo " << error.albedo << ": " << error.rmse << ", " << error.rmse_16_bits << ", "
                   << error.rmse_8_bits);
    CHECK(error.rmse <
          (error.albedo == kSeenAlbedo ? 1e-6 : 0.015));  // there exact, but for single precision
    CHECK(error.rmse_16_bits < error.rmse + 1e-4);
    CHECK(error.rmse_8_bits < error.rmse + 0.003);
  }
}

}  // namespace
}  // namespace heightlight
