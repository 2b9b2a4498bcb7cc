#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/parallel.h"
#include "base/texel_algebra.h"
#include "gloss/lobe_visibility.h"
#include "heightlight/error.h"
#include "heightlight/gloss.h"
#include "test_maps.h"
#include "visibility/exact_sky.h"

// Specular occlusion, the truth: lobes, and what they see.

namespace heightlight {
namespace {

using std::numbers::pi;

/// ∫ g(ω) f_r cosθ dω over the hemisphere, on a grid of its own: fine steps in the elevation and around.
template <class Function>
double integrate_lobe(const Gloss& gloss, const Eigen::Vector3d& view, Function&& g) {
  constexpr int kRings = 1500;
  constexpr int kSteps = 720;
  double sum = 0;
  for (int i = 0; i < kRings; ++i) {
    const double z = (i + 0.5) / kRings;
    const double sine = std::sqrt(1 - z * z);
    for (int k = 0; k < kSteps; ++k) {
      const double azimuth = 2 * pi * (k + 0.5) / kSteps;
      const Eigen::Vector3d light(sine * std::cos(azimuth), sine * std::sin(azimuth), z);
      sum += g(light) * ggx_lobe(gloss, view, light);
    }
  }
  return sum * 2 * pi / kRings / kSteps;
}

const std::vector<Eigen::Vector3d> kViews{{0, 0, 1}, {0.6, 0, 0.8}, {-0.3, 0.9, 0.316227766}};

/// A hollow of a sphere: the receiver in the middle sees a cap.
Surface make_cap(int size) {
  return build_surface(make_map(size, size, Boundary::open, [&](int row, int column) {
    const double x = (column - size / 2) / (0.45 * size);
    const double y = (row - size / 2) / (0.45 * size);
    const double squared = std::min(1.0, x * x + y * y);
    return 0.45 * (1 - std::sqrt(1.5625 - squared) + 0.25);  // the rim is 1 wide and 0.5 high
  }));
}

}  // namespace

TEST_CASE("samples of GGX integrate as its lobe does", "[gloss]") {
  for (const double roughness : {0.2, 0.5, 1.0}) {
    for (const Eigen::Vector3d& v : kViews) {
      const Eigen::Vector3d view = v.normalized();
      const Gloss gloss{.roughness = roughness, .reflectance = 0.3};
      std::vector<LobeSample> samples;
      sample_ggx(gloss, view, 100000, {0.3, 0.7}, samples);
      double whole = 0;
      double part = 0;
      for (const LobeSample& sample : samples) {
        whole += sample.weight / 100000;
        part += sample.weight / 100000 * sample.direction.z() * (1 + sample.direction.x());
      }
      INFO(roughness << " " << view.transpose());
      // Monte Carlo (a lattice of 10⁵) and discretisation
      CHECK(whole == Approx(integrate_lobe(gloss, view, [](const auto&) { return 1; })).epsilon(1e-3));
      CHECK(part == Approx(integrate_lobe(gloss, view, [](const Eigen::Vector3d& l) {
                      return l.z() * (1 + l.x());
                    })).epsilon(1e-3));
    }
  }
}

TEST_CASE("in the open a lobe sees all of the sky, at every roughness and view", "[gloss]") {
  const Surface plane = build_surface(make_map(9, 9, Boundary::tile, [](int, int) { return 0.3; }));
  const Surface tilted = build_surface(
      make_map(9, 9, Boundary::open, [](int row, int column) { return 0.1 * row + 0.05 * column; }));
  for (const Surface* surface : {&plane, &tilted}) {
    for (const double roughness : {0.001, 0.02, 0.13, 0.4, 1.0}) {
      for (const Vector3 view : {Vector3{0, 0, 1}, Vector3{0.5F, 0.1F, 0.4F}, Vector3{0.3F, -0.9F, 0.2F}}) {
        const SpecularOcclusion found =
            specular_occlusion(*surface, {.gloss = {.roughness = roughness}, .view = view, .rays = 64});
        CHECK(found.rmse == 0);
        for (const float share : found.occlusion.values) {
          if (!std::isnan(share)) CHECK(share == 1);  // identity
        }
      }
    }
  }
}

TEST_CASE("the middle of a round pit sees the lobe's part within a cap", "[gloss]") {
  constexpr int kSize = 129;
  const Surface cap = make_cap(kSize);
  const int middle = kSize / 2;
  const ExactWalker walker(cap, 64);
  SliceView slices;
  walker.view(middle, middle, slices);
  double sine = 0;
  for (const double horizon : slices.horizon_rad) sine += std::sin(horizon) / 64;
  CHECK(sine == Approx(std::sqrt(0.2)).margin(0.01));  // the rim is half as high as it is far
  const RayCaster caster(cap, {.rays = 16384});
  LobeWorkspace work(16384);
  for (const double roughness : {0.13, 0.4, 1.0}) {
    for (const Eigen::Vector3d& v : kViews) {
      const Gloss gloss{.roughness = roughness};
      const Eigen::Vector3d view = v.normalized();
      const double whole = integrate_lobe(gloss, view, [](const auto&) { return 1; });
      const double open =
          integrate_lobe(gloss, view, [&](const Eigen::Vector3d& l) { return l.z() > sine ? 1 : 0; });
      const LobeShare found = look_by_rays(
          caster, cap, middle, middle, {.sampler = ggx_sampler(gloss), .view = view, .rays = 16384}, work);
      INFO(roughness << " " << view.transpose());
      CHECK(found.open == Approx(open / whole).margin(0.004));  // discretisation: the rim is no circle
      CHECK(found.error < 0.002);
    }
  }
}

TEST_CASE("Lambert's lobe sees A", "[gloss]") {
  const Surface surface = build_surface(make_synth_map("brick", 48, Boundary::tile, 0.2));
  const RayCaster caster(surface, {.rays = 4096});
  const ExactWalker walker(surface, 512);
  LobeWorkspace work(4096);
  const LookedLobe lobe{.sampler = lambert_sampler(), .rays = 4096};
  for (int i = 0; i < 24; ++i) {
    const int row = static_cast<int>(scramble(static_cast<std::uint64_t>(i)) % 48);
    const int column = static_cast<int>(scramble(static_cast<std::uint64_t>(i) + 99) % 48);
    const LobeShare found = look_by_rays(caster, surface, row, column, lobe, work);
    INFO(row << " " << column);
    CHECK(found.open == Approx(find_exact_sky(walker, row, column).sky_view_factor)
                            .margin(6 * found.error + 2e-3));  // Monte Carlo, six standard errors
  }
}

TEST_CASE("rays and exact horizons see the same lobes", "[gloss]") {
  const Surface surface = build_surface(make_rough_map(24, 20, Boundary::tile, 0.15, 0.05, 5));
  const RayCaster caster(surface, {.rays = 256});
  const ExactWalker walker(surface, 4);
  LobeWorkspace work(256);
  double squares = 0;
  int count = 0;
  for (const double roughness : {0.02, 0.13, 0.4}) {
    const LookedLobe lobe{.sampler = ggx_sampler({.roughness = roughness}),
                          .view = Eigen::Vector3d(0.5, 0.3, 0.7).normalized()};
    for (int row = 0; row < 20; ++row) {
      for (int column = 0; column < 24; column += 3) {
        const double by_rays = look_by_rays(caster, surface, row, column, lobe, work).open;
        const double by_horizons = look_by_horizons(walker, row, column, lobe, work).open;
        REQUIRE(std::isnan(by_rays) == std::isnan(by_horizons));
        if (std::isnan(by_rays)) continue;
        squares += (by_rays - by_horizons) * (by_rays - by_horizons);
        ++count;
      }
    }
  }
  REQUIRE(count > 100);
  CHECK(std::sqrt(squares / count) < 1e-3);  // identity, but for directions that graze an edge in floats
}

TEST_CASE("the error of specular occlusion is what it says", "[gloss]") {
  const Surface surface = build_surface(make_synth_map("brick", 32, Boundary::tile, 0.15));
  const SpecularOptions options{.gloss = {.roughness = 0.4}, .view = {0.4F, 0.2F, 0.8F}, .rays = 128};
  SpecularOptions many = options;
  many.rays = 4096;
  many.seed = 7;
  const SpecularOcclusion found = specular_occlusion(surface, options);
  const SpecularOcclusion truth = specular_occlusion(surface, many);
  double squares = 0;
  int count = 0;
  for (std::size_t i = 0; i < found.occlusion.size(); ++i) {
    const double difference = double{found.occlusion.values[i]} - double{truth.occlusion.values[i]};
    if (std::isnan(difference)) continue;
    squares += difference * difference;
    ++count;
  }
  CHECK(std::sqrt(squares / count) < 1.1 * found.rmse);
  CHECK(std::sqrt(squares / count) > 0.5 * found.rmse);
  CHECK(truth.rmse < 0.2 * found.rmse);
}

TEST_CASE("specular occlusion takes as many rays as an error wants", "[gloss]") {
  const Surface surface = build_surface(make_synth_map("brick", 32, Boundary::tile, 0.15));
  int before = 0;
  for (const double error : {0.05, 0.004, 0.001}) {
    const SpecularOcclusion found = specular_occlusion(surface, {.rays = 0, .error = error});
    CHECK(found.rmse <= error);
    CHECK(found.rays > before);
    CHECK(found.occlusion.values == specular_occlusion(surface, {.rays = found.rays}).occlusion.values);
    before = found.rays;
  }
  CHECK_THROWS_AS(specular_occlusion(surface, {.rays = 0, .error = 0}), UsageError);
}

TEST_CASE("specular occlusion does not depend on threads", "[gloss]") {
  const Surface surface = build_surface(make_rough_map(17, 13, Boundary::open, 0.2, 0.1, 3));
  const auto with_threads = [&](int threads) {
    const ThreadScope scope(threads);
    return specular_occlusion(surface, {.rays = 32}).occlusion;
  };
  const Map one = with_threads(1);
  const Map three = with_threads(3);
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (!std::isnan(one.values[i])) CHECK(one.values[i] == three.values[i]);
  }
}

TEST_CASE("specular occlusion refuses what is out of range", "[gloss]") {
  const Surface plane = build_surface(make_map(3, 3, Boundary::tile, [](int, int) { return 0; }));
  for (const double roughness : {0.0, -0.1, 1.5, std::nan("")})
    CHECK_THROWS_AS(specular_occlusion(plane, {.gloss = {.roughness = roughness}}), UsageError);
  CHECK_THROWS_AS(specular_occlusion(plane, {.gloss = {.reflectance = 2}}), UsageError);
  for (const Vector3 view : {Vector3{1, 0, 0}, Vector3{0, 0.1F, -1}, Vector3{0, 0, std::nanf("")}})
    CHECK_THROWS_AS(specular_occlusion(plane, {.view = view}), UsageError);
  CHECK_THROWS_AS(specular_occlusion(plane, {.rays = 8}), UsageError);
}

}  // namespace heightlight
