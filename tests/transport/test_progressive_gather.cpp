#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/hash.h"
#include "base/parallel.h"
#include "base/texel_algebra.h"
#include "test_maps.h"
#include "transport/progressive_gather.h"
#include "transport/root_mean_square.h"
#include "visibility/horizon_sky.h"

namespace heightlight {
namespace {

/// So many azimuths, and such fine walks, that ending is what is left.
constexpr ProgressiveGoal kFine{.error = 0.001, .last_azimuths = 64};

/// A small map with A by exact walks, and all that gathers need.
struct KnownGround {
  Surface surface;
  FormFactors exact;
  MapGather gather;

  explicit KnownGround(Heightmap map, int azimuths = 96, int samples_per_octave = 48)
      : surface(build_surface(std::move(map))),
        exact(build_exact_form_factors(surface, azimuths, {})),
        gather(surface, build_height_pyramid(surface),
               {.samples_per_octave = samples_per_octave, .peak_share = 0.3F}) {}
  KnownGround(const KnownGround&) = delete;  // the gather refers to the surface
  KnownGround& operator=(const KnownGround&) = delete;

  ProgressiveSolution solve(const std::vector<IrradianceSystem>& systems,
                            const ProgressiveGoal& goal = kFine) const {
    return gather_progressively(gather, exact.sky_view_factor, systems, goal, {});
  }

  TexelVector total(const IrradianceSystem& system) const { return solve(std::vector{system}).irradiance[0]; }

  /// On stored exact form factors.
  TexelVector exact_total(const IrradianceSystem& system) const {
    return exact.solve({system}, {}).irradiance[0];
  }

  double error_of(const IrradianceSystem& system) const {
    return rms(as_eigen(total(system)) - as_eigen(exact_total(system)));
  }
};

Heightmap make_known_ground(const std::string& name) {
  if (name == "bricks, a tenth") return make_synth_map("brick", 48, Boundary::tile, 0.1);
  if (name == "bricks, a third") return make_synth_map("brick", 48, Boundary::tile, 0.3);
  if (name == "a bowl") return make_synth_map("bowl", 48, Boundary::open, 0.3);
  return make_synth_map("bowl", 48, Boundary::open, 0.6);
}

/// Light that is no sky's: bright in one half of the map.
TexelVector half_light(const Surface& surface) {
  TexelVector light(surface.map.height.size());
  for (std::size_t i = 0; i < light.size(); ++i) {
    const bool right =
        2 * (i % static_cast<std::size_t>(surface.width())) > static_cast<std::size_t>(surface.width());
    light[i] = right ? 1 : 0.1;
  }
  return light;
}

/// In [0, 0.95], the same in squares of 4 × 4 texels.
TexelVector patchy_albedo(const Surface& surface) {
  TexelVector albedo(surface.map.height.size());
  for (int row = 0; row < surface.height(); ++row) {
    for (int column = 0; column < surface.width(); ++column) {
      albedo[surface.map.height.index(row, column)] =
          0.95 * unit_real(hash_combine(5, static_cast<std::uint64_t>(row / 4 * 1000 + column / 4)));
    }
  }
  return albedo;
}

/// A by a cheap walk.
Map make_walked_sky(const Surface& surface, const HeightPyramid& pyramid) {
  return walk_horizon_sky(surface, pyramid,
                          {.walk = {.azimuths = 16, .samples_per_octave = 8, .peak_share = 0.3F}})
      .sky_view_factor;
}

TEST_CASE("totals by few gathers are those of exact form factors", "[transport][gather]") {
  struct Case {
    std::string name;
    double under_sky, own;
  };
  // discretisation: of the walks, and of fields that are not smooth; truncation and few azimuths: half of the
  // error wanted, 1e-3 (measured: 2.5e-4 and 8e-4, 1.1e-3 and 3.0e-3, 2.1e-4 and 1.8e-3, 2.0e-4 and 1.8e-3)
  const Case given = GENERATE(Case{"bricks, a tenth", 5e-4, 1.2e-3}, Case{"bricks, a third", 1.6e-3, 4e-3},
                              Case{"a bowl", 4e-4, 2.2e-3}, Case{"a deep bowl", 6e-4, 2.2e-3});
  const KnownGround ground(make_known_ground(given.name));
  for (const double albedo : {0.3, 0.8, 0.95}) {
    const double error = ground.error_of({.albedo = albedo});
    INFO(given.name << ", albedo " << albedo << ": " << error);
    CHECK(error < given.under_sky);
  }
  const TexelVector light = half_light(ground.surface);
  const TexelVector patchy = patchy_albedo(ground.surface);
  const double own = ground.error_of({.direct = &light, .albedo = 0.8});
  const double varying = ground.error_of({.varying = &patchy});
  const double both = ground.error_of({.direct = &light, .varying = &patchy});
  INFO(given.name << ", light of one's own: " << own << ", an albedo that varies: " << varying
                  << ", both: " << both);
  CHECK(own < given.own);
  CHECK(varying < given.own);
  CHECK(both < given.own);
}

TEST_CASE("light of one's own that is the sky's gives the sky's totals", "[transport][gather]") {
  const std::string name = GENERATE("bricks, a third", "a deep bowl");
  const KnownGround ground(make_known_ground(name));
  for (const double albedo : {0.3, 0.8, 1.0}) {
    const TexelVector own = ground.total({.direct = &ground.exact.direct, .albedo = albedo});
    const TexelVector sky = ground.total({.albedo = albedo});
    const double difference = rms(as_eigen(own) - as_eigen(sky));
    INFO(name << ", albedo " << albedo << ": " << difference);
    CHECK(difference < kFine.error);  // truncation: either may leave half of it
  }
}

TEST_CASE("at albedo 1 the sky's total is 1 everywhere", "[transport][gather]") {
  const std::string name = GENERATE("bricks, a tenth", "bricks, a third", "a deep bowl");
  const KnownGround ground(make_known_ground(name));
  const TexelVector ones(ground.exact.direct.size(), 1);
  // It begins at 1, of which gathers keep 1: rounding, single precision.
  for (const TexelVector& total : {ground.total({.albedo = 1}), ground.total({.varying = &ones})})
    CHECK((as_eigen(total).array() - 1).abs().maxCoeff() < 1e-6);
}

TEST_CASE("at albedo 0 totals are the direct irradiance", "[transport][gather]") {
  const KnownGround ground(make_known_ground("bricks, a third"));
  const TexelVector light = half_light(ground.surface);
  const TexelVector black(light.size(), 0);
  const auto same = [](const TexelVector& total, const TexelVector& direct) {
    return (as_eigen(total) - as_eigen(direct)).cwiseAbs().maxCoeff() < 1e-7;  // rounding, single precision
  };
  CHECK(same(ground.total({.albedo = 0}), ground.exact.direct));
  CHECK(same(ground.total({.varying = &black}), ground.exact.direct));
  CHECK(same(ground.total({.direct = &light, .albedo = 0}), light));
  CHECK(same(ground.total({.direct = &black, .albedo = 0.8}), black));
}

TEST_CASE("a flat map's totals are its direct irradiance, whatever its albedo", "[transport][gather]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const KnownGround ground(make_map(20, 13, boundary, [](int, int) { return 0.3; }), 16, 8);
  const TexelVector light = half_light(ground.surface);
  for (const double albedo : {0.3, 0.9, 1.0}) {
    CHECK(ground.total({.albedo = albedo}) == TexelVector(20 * 13, 1));
    const TexelVector own = ground.total({.direct = &light, .albedo = albedo});
    CHECK((as_eigen(own) - as_eigen(light)).cwiseAbs().maxCoeff() < 1e-7);  // rounding, single precision
  }
}

TEST_CASE("each total is the same, to the last bit, whatever others are solved beside it",
          "[transport][gather]") {
  const KnownGround ground(make_rough_map(70, 45, Boundary::tile, 0.2, 0.1, 3), 16, 8);
  const TexelVector light = half_light(ground.surface);
  const TexelVector patchy = patchy_albedo(ground.surface);
  const ProgressiveGoal goal{.error = 0.004, .last_azimuths = 8};
  // More than one gather reads at once, and of different numbers of gathers.
  const std::vector<IrradianceSystem> systems{
      {.albedo = 0.95}, {.albedo = 0.2},      {.albedo = 0.8}, {.direct = &light, .albedo = 0.8},
      {.albedo = 0},    {.varying = &patchy}, {.albedo = 0.8}, {.direct = &light, .varying = &patchy},
      {.albedo = 0.6}};
  const ProgressiveSolution together = ground.solve(systems, goal);
  REQUIRE(together.irradiance.size() == systems.size());
  int most = 0;
  for (std::size_t i = 0; i < systems.size(); ++i) {
    const ProgressiveSolution alone = ground.solve({systems[i]}, goal);
    INFO("system " << i);
    CHECK(alone.irradiance[0] == together.irradiance[i]);
    most = std::max(most, alone.gathers);
  }
  CHECK(together.gathers == most);
  std::vector<IrradianceSystem> reversed(systems.rbegin(), systems.rend());
  std::vector<TexelVector> backwards = ground.solve(reversed, goal).irradiance;
  std::reverse(backwards.begin(), backwards.end());
  CHECK(backwards == together.irradiance);
  CHECK(ground.solve(std::vector<IrradianceSystem>{}, goal).irradiance.empty());
}

TEST_CASE("totals do not depend on the number of threads", "[transport][gather]") {
  const Surface surface = build_surface(make_rough_map(150, 131, Boundary::open, 0.2, 0.1, 6));
  const HeightPyramid pyramid = build_height_pyramid(surface);
  const Map sky = make_walked_sky(surface, pyramid);
  const TexelVector light = half_light(surface);
  const std::vector<IrradianceSystem> systems{{.albedo = 0.8}, {.direct = &light, .albedo = 0.5}};
  const auto solve = [&](int threads) {
    const ThreadScope scope(threads);
    const MapGather gather(surface, pyramid, {.samples_per_octave = 8, .peak_share = 0.3F});
    return gather_progressively(gather, sky, systems, {.error = 0.002, .last_azimuths = 8}, {});
  };
  const ProgressiveSolution one = solve(1);
  for (const int threads : {1, 3}) {
    const ProgressiveSolution other = solve(threads);
    CHECK(other.irradiance == one.irradiance);
    CHECK(other.gathers == one.gathers);
  }
}

TEST_CASE("a smaller error takes more gathers, and brighter ground too", "[transport][gather]") {
  const KnownGround ground(make_known_ground("bricks, a third"), 16, 8);
  const auto gathers = [&](double albedo, double error) {
    return ground.solve({{.albedo = albedo}}, {.error = error, .last_azimuths = 8}).gathers;
  };
  CHECK(gathers(0.8, 0.01) < gathers(0.8, 0.0001));
  CHECK(gathers(0.3, 0.001) < gathers(0.9, 0.001));
  CHECK(gathers(1 - 1e-9, 1e-9) <= 64);
}

TEST_CASE("where samples are missing totals are 0, and the rest is as exact", "[transport][gather]") {
  Heightmap map = make_synth_map("brick", 48, Boundary::open, 0.2);
  for (int row = 10; row < 30; ++row) {
    for (int column = 20; column < 35; ++column)
      map.height(row, column) = std::numeric_limits<float>::quiet_NaN();
  }
  map.height(40, 7) = map.height(10, 20);
  const KnownGround ground(map);
  for (const double albedo : {0.3, 0.8, 0.95}) {
    const TexelVector total = ground.total({.albedo = albedo});
    for (std::size_t i = 0; i < total.size(); ++i) {
      const bool hole = std::isnan(map.height.values[i]);
      REQUIRE((hole ? total[i] == 0 : total[i] > 0 && total[i] < 1 + 1e-6));
    }
    const double error = rms(as_eigen(total) - as_eigen(ground.exact_total({.albedo = albedo})));
    INFO("albedo " << albedo << ": " << error);
    CHECK(error < 1.3e-3);  // discretisation, as above (measured: 9e-4)
  }
}

TEST_CASE("totals of hard little maps are finite, no darker than the direct irradiance, and 1 at most",
          "[transport][gather]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const double missing = GENERATE(0.0, 0.4);
  const auto [width, height] =
      GENERATE(std::pair{37, 5}, std::pair{1, 11}, std::pair{17, 1}, std::pair{3, 2}, std::pair{1, 1});
  const double relief = GENERATE(0.02, 0.5, 20.0);
  const Surface surface = build_surface(make_rough_map(width, height, boundary, relief, missing, 2));
  const HeightPyramid pyramid = build_height_pyramid(surface);
  const Map sky = make_walked_sky(surface, pyramid);
  const MapGather gather(surface, pyramid, {.samples_per_octave = 8, .peak_share = 0.3F});
  const std::vector<IrradianceSystem> systems{{.albedo = 0.8}, {.albedo = 1 - 1e-7}};
  const ProgressiveSolution solution =
      gather_progressively(gather, sky, systems, {.error = 0.002, .last_azimuths = 4}, {});
  for (const TexelVector& total : solution.irradiance) {
    for (std::size_t i = 0; i < total.size(); ++i) {
      if (std::isnan(sky.values[i])) {
        REQUIRE(total[i] == 0);
      } else {
        REQUIRE(total[i] >= double{sky.values[i]} - 1e-6);  // rounding, single precision
        REQUIRE(total[i] <= 1 + 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace heightlight
