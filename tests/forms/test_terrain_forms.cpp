#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "heightlight/error.h"
#include "heightlight/terrain_forms.h"
#include "test_maps.h"

// Formulas for what terrain reflects: their limits, and windows' means.

namespace heightlight {
namespace {

/// A texel of a place that is everywhere alike, under an even sky.
TerrainInputs alike(double sky, double albedo) {
  return {.direct = sky,
          .level = 1,
          .albedo = albedo,
          .sky_view_factor = SkyViewFactor(sky),
          .configuration = 1 - sky,
          .window = {.albedo = albedo,
                     .direct = sky,
                     .surface_share = 1 - sky,
                     .configuration = 1 - sky,
                     .seen_direct = sky,
                     .seen_sky = sky},
          .expected_seen = SeenSkyViewFactor(sky),
          .deep_seen = SeenSkyViewFactor(sky)};
}

const TerrainForm& form_named(const std::string& name) {
  const std::vector<TerrainForm>& forms = terrain_forms();
  return *std::find_if(forms.begin(), forms.end(),
                       [&](const TerrainForm& form) { return form.name == name; });
}

TexelVector ones(const Surface& surface) { return TexelVector(surface.map.height.size(), 1.0); }

}  // namespace

TEST_CASE("terrain that is not seen reflects nothing, nor does black terrain", "[forms][terrain]") {
  for (const TerrainForm& form : terrain_forms()) {
    INFO(form.name);
    TerrainInputs open = alike(1, 0.9);
    open.window = alike(0.6, 0.9).window;  // whatever stands around
    CHECK(form.evaluate(open) == Approx(1).margin(form.name == "cubic" ? 1e-4 : 1e-15));
    // The cubic was fitted from albedo 0.1 on: at 0 it is below A, by up to 0.044.
    CHECK(form.evaluate(alike(0.4, 0)) == Approx(0.4).margin(form.name == "cubic" ? 0.044 : 1e-15));
  }
}

TEST_CASE("series are exact in a cavity that is everywhere alike", "[forms][terrain]") {
  // A spherical cap: every place sees as much of the sky, and every other place alike.
  for (const double sky : {0.05, 0.3, 0.8, 1.0}) {
    for (const double albedo : {0.15, 0.6, 0.9, 1.0}) {
      const double exact = uniform_neighbourhood(SkyViewFactor(sky), albedo);
      const TerrainInputs in = alike(sky, albedo);
      INFO(sky << " " << albedo);
      CHECK(form_named("window_series").evaluate(in) == Approx(exact).epsilon(1e-14));  // identity
      CHECK(form_named("own_series").evaluate(in) == Approx(exact).epsilon(1e-14));
      // As bright as a level plain is too bright, one reflection too little.
      CHECK(form_named("level_series").evaluate(in) >= exact - 1e-14);
      CHECK(form_named("average_albedo").evaluate(in) <= exact + 1e-14);
      CHECK(form_named("level_terrain").evaluate(in) == Approx(sky + albedo * (1 - sky)).epsilon(1e-14));
    }
  }
}

TEST_CASE("under an even sky ours are the closed forms", "[forms][terrain]") {
  TerrainInputs in = alike(0.5, 0.6);
  in.expected_seen = SeenSkyViewFactor(0.7);
  in.deep_seen = SeenSkyViewFactor(0.4);
  const SkyViewFactor sky(0.5);
  CHECK(form_named("seen_from_map").evaluate(in) ==
        Approx(bounced_total(sky, guess_seen_on_map(sky, in.expected_seen), 0.6)).epsilon(1e-15));
  CHECK(form_named("seen_from_deep").evaluate(in) ==
        Approx(bounced_total(sky, guess_seen_in_deep(sky, in.deep_seen), 0.6)).epsilon(1e-15));
  // What is reflected goes with how bright the neighbourhood is.
  const double even = form_named("seen_from_deep").evaluate(in) - in.direct;
  in.direct = 0.1;
  in.window.seen_direct /= 2;
  CHECK(form_named("seen_from_deep").evaluate(in) == Approx(0.1 + even / 2).epsilon(1e-14));
}

TEST_CASE("an infinite slope has no terrain to see", "[forms][terrain]") {
  for (const double cosine : {1.0, 0.8, 0.3}) {
    CHECK(terrain_configuration(cosine, (1 + cosine) / 2) == 0);
    CHECK(terrain_configuration(cosine, (1 + cosine) / 2 + 1e-9) == 0);  // never less
    CHECK(terrain_configuration(cosine, 0) == (1 + cosine) / 2);
  }
}

TEST_CASE("a window's mean is that of a box", "[forms][terrain]") {
  const Boundary boundary = GENERATE(Boundary::open, Boundary::tile);
  const double radius = GENERATE(0.0, 0.9, 1.0, 2.6, 40.0);
  Heightmap map = make_rough_map(11, 7, boundary, 1, 0.2, 5);
  map.spacing = {1, 1.3};
  const Surface surface = build_surface(map);
  TexelVector values(map.height.size());
  TexelVector weights(map.height.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = unit_real(scramble(i));
    weights[i] = unit_real(scramble(i + 1000));
  }
  const TexelVector mean = window_mean(surface, values, weights, radius);
  const int across = static_cast<int>(radius);
  const int down = static_cast<int>(radius / 1.3);
  for (int row = 0; row < 7; ++row) {
    for (int column = 0; column < 11; ++column) {
      double sum = 0;
      double all = 0;
      for (int i = row - down; i <= row + down; ++i) {
        for (int j = column - across; j <= column + across; ++j) {
          const bool outside = i < 0 || i >= 7 || j < 0 || j >= 11;
          if (outside && boundary == Boundary::open) continue;
          const std::size_t texel = map.height.index(((i % 7) + 7) % 7, ((j % 11) + 11) % 11);
          if (std::isnan(map.height.values[texel])) continue;
          sum += weights[texel] * values[texel];
          all += weights[texel];
        }
      }
      const bool missing = std::isnan(map.height(row, column));
      // Identity: differences of sums along lines.
      CHECK(mean[map.height.index(row, column)] == Approx(missing ? 0 : sum / all).margin(1e-11));
    }
  }
}

TEST_CASE("windows are the same for any number of threads, and refuse what makes no sense",
          "[forms][terrain]") {
  const Surface surface = build_surface(make_rough_map(30, 20, Boundary::open, 1, 0, 5));
  TexelVector values(surface.map.height.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = unit_real(scramble(i));
  const auto with_threads = [&](int threads) {
    const ThreadScope scope(threads);
    return window_mean(surface, values, ones(surface), 0.1);
  };
  CHECK(with_threads(1) == with_threads(3));
  CHECK_THROWS_AS(window_mean(surface, values, {1.0}, 1), UsageError);
  CHECK_THROWS_AS(window_mean(surface, {1.0}, ones(surface), 1), UsageError);
  CHECK_THROWS_AS(window_mean(surface, values, ones(surface), -1), UsageError);
  CHECK_THROWS_AS(window_mean(surface, values, ones(surface), std::nan("")), UsageError);
}

}  // namespace heightlight
