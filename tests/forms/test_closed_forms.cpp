#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "heightlight/closed_forms.h"
#include "heightlight/transport.h"
#include "test_maps.h"

namespace heightlight {
namespace {

using Alpha = AmbientOcclusion<double>;
using Sky = SkyViewFactor<double>;
using Seen = SeenSkyViewFactor<double>;

// The wrong AO does not compile, nor does a bare number.
static_assert(!std::is_convertible_v<double, Alpha> && !std::is_convertible_v<double, Sky>);
static_assert(!std::is_constructible_v<Alpha, Sky> && !std::is_constructible_v<Sky, Alpha>);
template <class Occlusion>
constexpr bool kNotesTake = requires(Occlusion ao) {
  notes_total(ao, 0.5);
};
template <class Occlusion>
constexpr bool kCubicTakes = requires(Occlusion ao) {
  cubic_total(ao, 0.5);
};
static_assert(kNotesTake<Alpha> && !kNotesTake<Sky> && !kNotesTake<double>);
static_assert(kCubicTakes<Sky> && !kCubicTakes<Alpha> && !kCubicTakes<double>);

const std::vector<double> kEdges = {0,      1e-7,  0.1,   0.25, 0.5,      0.764, 0.9493,  0.957,
                                    0.9703, 0.993, 0.999, 1,    1 - 1e-7, 1e-30, 1 + 1e-7};
const std::vector<double> kAlbedos = {0, 1e-7, 0.1, 0.2, 0.3, 0.5, 0.7, 0.8, 0.9, 0.99, 1 - 1e-7, 1};

ModelInputs inputs(double ao, double other) {
  return {Alpha(ao), Sky(ao), Seen(other), Seen(other), Seen(other), Seen(other)};
}

}  // namespace

TEST_CASE("closed forms are finite, in [0, 1] and rise with albedo, to the edges of their domain",
          "[forms]") {
  for (const ClosedForm& form : closed_forms()) {
    for (const double ao : kEdges) {
      for (const double other : {0.0, 1e-7, 0.3, 1 - 1e-7, 1.0}) {
        double before = 0;
        for (const double albedo : kAlbedos) {
          const std::optional<double> total = form.evaluate(inputs(ao, other), albedo);
          INFO(form.name << " AO " << ao << " other " << other << " albedo " << albedo);
          if (form.name != "notes") REQUIRE(total);
          if (!total) continue;
          REQUIRE(std::isfinite(*total));
          CHECK(*total >= 0);
          CHECK(*total <= 1 + 1e-15);       // identity: a few roundings of 1
          CHECK(*total >= before - 4e-15);  // identity
          before = *total;
        }
      }
    }
  }
}

TEST_CASE("the notes' form says nothing outside its domain, and guarded it is continuous there", "[forms]") {
  const std::vector<double> outside = {0.9494, 0.957, 0.9703, 0.993, 1 - 1e-7, 1, 1 + 1e-7};
  for (const double alpha : outside) {
    CAPTURE(alpha);
    CHECK(std::isnan(notes_ratio(Alpha(alpha))));
    for (const double albedo : kAlbedos) {
      CHECK(std::isnan(notes_total(Alpha(alpha), albedo)));
      CHECK(notes_total_guarded(Alpha(alpha), albedo) == 1);
    }
  }
  CHECK(notes_direct(Alpha(0.9492)) < 1);
  CHECK(notes_direct(Alpha(0.9494)) > 1);
  CHECK(notes_direct(Alpha(0.9832)) == Approx(1.0061).margin(1e-4));  // golden: its maximum
  CHECK(notes_ratio(Alpha(0.763)) > 0);
  CHECK(notes_ratio(Alpha(0.7645)) < 0);
  CHECK(std::isnan(notes_total(Alpha(0), 1.0)));
  CHECK(notes_total(Alpha(0), 1 - 1e-7) == 0);
  for (const double albedo : kAlbedos) {
    CHECK(notes_total(Alpha(0.9492), albedo) == Approx(1).margin(1e-4));
  }
}

TEST_CASE("the notes' form is its equations, word by word", "[forms]") {
  for (const double a : {0.05, 0.3, 0.6, 0.8, 0.93}) {
    const double f0 = a * (1 + std::pow(1 - a, 0.75) / 2);
    const double f1 =
        27.576937094210385 * a * std::pow(1 - a, 1.5) * std::exp(-3.3364392003423804 * std::pow(a, 0.25));
    const double tau = 1 - f1 / (1 - f0);
    for (const double albedo : {0.1, 0.5, 0.9, 1.0}) {
      CHECK(notes_total(Alpha(a), albedo) ==
            Approx(f0 + albedo / (1 - albedo * tau) * f1).epsilon(1e-13));  // identity
    }
    CHECK(notes_ratio(Alpha(a)) == Approx(tau).margin(1e-13));
  }
}

TEST_CASE("the cubic is eq. 33 with what is wrong of it", "[forms]") {
  CHECK(cubic_total(Sky(0.5), 1.0) == Approx(0.898).margin(5e-4));  // golden, by hand
  CHECK(0.3218 - cubic_total(Sky(0.3218), 0.0) == Approx(0.0443).margin(1e-4));
  CHECK(cubic_total(Sky(1.0), 0.5) == Approx(0.99985).margin(1e-12));
  CHECK(cubic_total(Sky(1.0), 1.0) == 1);
}

TEST_CASE("what holds at albedo 0 and 1", "[forms]") {
  for (const double a : kEdges) {
    for (const double n : kEdges) {
      INFO("A " << a << " n " << n);
      const double sky = clamp_share(a);
      CHECK(bounced_total(Sky(a), Seen(n), 0.0) == sky);
      CHECK(bounced_total(Sky(a), Seen(n), 1.0) == Approx(1).margin(3e-16));  // identity
    }
    CHECK(uniform_neighbourhood(Sky(a), 0.0) == clamp_share(a));
    CHECK(uniform_neighbourhood(Sky(a), 1.0) == 1);
    for (const double albedo : kAlbedos) {
      CHECK(bounced_total(Sky(a), Seen(a), albedo) ==
            Approx(uniform_neighbourhood(Sky(a), albedo)).epsilon(1e-14));  // identity: n = A is eq. 12
    }
  }
}

TEST_CASE("bounces of a spherical pit are those of G with n = A", "[forms]") {
  // every point of the cap sees the cap alike: E_b/π = (1 − f) f^b
  const double f = 0.35;
  double total = 0;
  for (int b = 0; b < 400; ++b) total += std::pow(0.8, b) * (1 - f) * std::pow(f, b);
  CHECK(bounced_total(Sky(1 - f), Seen(1 - f), 0.8) == Approx(total).epsilon(1e-13));  // identity
}

TEST_CASE("n comes back out of a total", "[forms]") {
  for (const double a : {0.0, 1e-7, 0.2, 0.5, 0.957, 0.993, 1 - 1e-7}) {
    for (const double n : {0.0, 1e-7, 0.1, 0.5, 0.9, 1.0}) {
      for (const double albedo : {1e-3, 0.3, 0.8, 0.999}) {
        INFO("A " << a << " n " << n << " albedo " << albedo);
        const double total = bounced_total(Sky(a), Seen(n), albedo);
        const Seen solved = seen_from_total(Sky(a), total, albedo);
        // identity: n itself where what is seen counts, and the total always
        CHECK(bounced_total(Sky(a), solved, albedo) == Approx(total).margin(1e-15));
        if (a < 0.99) CHECK(solved.value == Approx(n).margin(1e-10));
      }
    }
  }
  CHECK(seen_from_total(Sky(1.0), 1.0, 0.8).value == 1);
  CHECK(seen_from_total(Sky(1.0), 0.9999, 0.8).value == 1);
  CHECK(seen_from_total(Sky(0.5), 0.4, 0.8).value == 0);  // below the direct irradiance
  CHECK(seen_from_total(Sky(0.5), 1.1, 0.8).value == 1);
}

TEST_CASE("missing samples stay missing", "[forms]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const ClosedForm& form : closed_forms()) {
    INFO(form.name);
    const std::optional<double> total = form.evaluate(inputs(nan, 0.5), 0.5);
    REQUIRE(total);
    CHECK(std::isnan(*total));
  }
  CHECK(std::isnan(seen_from_total(Sky(nan), 0.5, 0.5).value));
  CHECK(std::isnan(seen_from_total(Sky(0.5), nan, 0.5).value));
}

TEST_CASE("single precision keeps to double within 16 ulp of 1", "[forms]") {
  // discretisation of floats: inputs are floats already, a handful of operations follow
  const float bound = 4 * std::numeric_limits<float>::epsilon();
  for (int i = 0; i <= 1000; ++i) {
    const float a = static_cast<float>(i) / 1000;
    const auto sky = SkyViewFactor(a);
    const auto sky_exact = Sky(double{a});
    for (const float albedo : {0.0F, 0.1F, 0.5F, 0.9F, 0.9999999F, 1.0F}) {
      const double rho = double{albedo};
      INFO("AO " << a << " albedo " << albedo);
      CHECK(std::abs(uniform_neighbourhood(sky, albedo) - uniform_neighbourhood(sky_exact, rho)) <= bound);
      // its terms are as large as 4 and cancel
      CHECK(std::abs(cubic_total(sky, albedo) - cubic_total(sky_exact, rho)) <= 4 * bound);
      for (const float n : {0.001F, 0.3F, 0.8F, 1.0F}) {
        CHECK(std::abs(bounced_total(sky, SeenSkyViewFactor(n), albedo) -
                       bounced_total(sky_exact, Seen(double{n}), rho)) <= bound);
      }
      CHECK(std::abs(bounced_total(sky, guess_seen(sky), albedo) -
                     bounced_total(sky_exact, guess_seen(sky_exact), rho)) <= bound);
      CHECK(std::abs(notes_total_guarded(AmbientOcclusion(a), albedo) -
                     notes_total_guarded(Alpha(double{a}), rho)) <= 4 * bound);
    }
  }
}

TEST_CASE("the ambient transfer sums per hit, and is eq. 12 where nothing is fuzzy", "[forms]") {
  using Hit = Occluder<double>;
  const std::vector<Hit> plain = {{0.1, 0, 0.6}, {0.3, 0, 0.6}};
  CHECK(ambient_transfer(Sky(0.6), plain) == Approx(uniform_neighbourhood(Sky(0.6), 0.6)).epsilon(1e-14));
  const std::vector<Hit> fuzzy = {{0.1, 0.5, 0.2}, {0.3, 0.25, 0.8}};
  const double open = 0.6 + 0.1 * 0.5 + 0.3 * 0.25;
  CHECK(ambient_transfer(Sky(0.6), fuzzy) ==
        Approx(open / (1 - (0.1 * 0.5 * 0.2 + 0.3 * 0.75 * 0.8))).epsilon(1e-14));
  const std::vector<Hit> white = {{1, 0, 1}};
  CHECK(ambient_transfer(Sky(0), white) == 1);
  CHECK(fuzzy_openness(0.25, 1.0) == 0.5);
  CHECK(fuzzy_openness(3.0, 2.0) == 1);
  CHECK(exponential_openness(0.0, 2.0) == 0);
  CHECK(exponential_openness(2.0, 2.0) == 1);
  CHECK(exponential_openness(0.5, 2.0) == Approx((1 - std::exp(-1.0)) / (1 - std::exp(-4.0))));
}

TEST_CASE("bounds of a total hold for any bounces, and for G", "[forms]") {
  // three decaying series of bounces that sum to 1 − A at albedo 1
  const double a = 0.3;
  const auto total = [a](double first, double last, double share, double albedo) {
    const auto series = [albedo](double ratio) { return albedo * (1 - ratio) / (1 - albedo * ratio); };
    return a + (1 - a) * (share * series(first) + (1 - share) * series(last));
  };
  for (const double albedo : kAlbedos) {
    for (const auto& [first, last, share] :
         {std::array{0.3, 0.99, 0.5}, std::array{0.0, 0.9, 0.2}, std::array{0.6, 0.6, 1.0}}) {
      INFO("albedo " << albedo << " ratios " << first << ' ' << last);
      const double known = total(first, last, share, 0.7);
      const TotalBounds<double> bounds = bound_total(Sky(a), known, 0.7, albedo);
      const double truth = albedo < 1 ? total(first, last, share, albedo) : 1;
      CHECK(bounds.low - 1e-12 <= truth);  // identity
      CHECK(truth <= bounds.high + 1e-12);
      const double guessed = bounced_total(Sky(a), seen_from_total(Sky(a), known, 0.7), albedo);
      CHECK(bounds.low - 1e-12 <= guessed);
      CHECK(guessed <= bounds.high + 1e-12);
    }
  }
  const TotalBounds<double> same = bound_total(Sky(a), 0.7, 0.7, 0.7);
  CHECK(same.low == Approx(0.7));
  CHECK(same.high == Approx(0.7));
  CHECK(bound_total(Sky(1.0), 1.0, 0.7, 0.5).low == 1);
}

TEST_CASE("bounds hold on a simulated map, texel by texel", "[forms]") {
  const Surface surface = build_surface(make_synth_map("brick", 48, Boundary::tile, 0.15));
  const auto transport = build_exact_form_factors(surface, 16, {});
  const std::vector<double> albedos{0.2, 0.5, 0.7, 0.9};
  std::vector<IrradianceSystem> systems;
  for (const double albedo : albedos) systems.push_back({.albedo = albedo});
  const std::vector<TexelVector> totals = transport.solve(systems, {}).irradiance;
  for (std::size_t i = 0; i < transport.sky_view_factor.size(); ++i) {
    const Sky sky(transport.direct[i]);
    for (std::size_t k = 0; k < albedos.size(); ++k) {
      const TotalBounds<double> bounds = bound_total(sky, totals[2][i], 0.7, albedos[k]);
      INFO("texel " << i << " albedo " << albedos[k]);
      CHECK(bounds.low - 1e-6 <= totals[k][i]);  // the solver's residual
      CHECK(totals[k][i] <= bounds.high + 1e-6);
    }
  }
}

TEST_CASE("reciprocity: s and the measured n agree where samples resolve the surface", "[forms]") {
  const Surface surface = build_surface(make_synth_map("sines", 96, Boundary::tile, 0.15));
  const auto transport = build_exact_form_factors(surface, 32, {});
  TexelVector first = transport.gather(transport.direct);
  const double s = expected_seen(transport.sky_view_factor, surface).value;
  const double measured = measured_seen(transport.sky_view_factor, first, surface).value;
  CHECK(s > 0.1);
  CHECK(s < 0.9);
  CHECK(measured == Approx(s).margin(0.01));  // discretisation: texels of 1/96
}

TEST_CASE("the one number of a map comes back out of its texels", "[forms]") {
  for (const double t : {0.05, 0.3, 0.7}) {
    SeenMoments moments;
    for (int i = 0; i <= 50; ++i) {
      const Sky sky(i / 50.0);
      moments.add(sky, guess_seen_in_deep(sky, Seen(t)));
    }
    CHECK(tune_deep_seen(moments).value == Approx(t).epsilon(1e-12));  // identity
  }
  SeenMoments open;
  open.add(Sky(1.0), Seen(1.0));
  CHECK(tune_deep_seen(open).value == 1);
  CHECK(tune_deep_seen(SeenMoments{}).value == 1);
}

TEST_CASE("the blur is a mean: constants stay, it commutes with shifts, holes are left out", "[forms]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Heightmap heights = make_rough_map(24, 17, Boundary::tile, 0.1, 0.1, 5);
  Map sky(24, 17, 0.4F);
  for (std::size_t i = 0; i < sky.size(); ++i) {
    if (std::isnan(heights.height.values[i])) sky.values[i] = static_cast<float>(nan);
  }
  const Map same = blur_seen(sky, true, 2);
  for (std::size_t i = 0; i < sky.size(); ++i) {
    if (std::isnan(sky.values[i])) {
      CHECK(std::isnan(same.values[i]));
    } else {
      CHECK(same.values[i] == Approx(0.4F));
    }
  }
  for (std::size_t i = 0; i < sky.size(); ++i) sky.values[i] *= 0.5F + static_cast<float>(i % 7) / 7;
  Map shifted = sky;
  for (int row = 0; row < 17; ++row) {
    for (int column = 0; column < 24; ++column) {
      shifted((row + 5) % 17, (column + 9) % 24) = sky(row, column);
    }
  }
  const Map blurred = blur_seen(sky, true, 2);
  const Map blurred_shifted = blur_seen(shifted, true, 2);
  for (int row = 0; row < 17; ++row) {
    for (int column = 0; column < 24; ++column) {
      const float before = blurred(row, column);
      if (std::isnan(before)) continue;
      CHECK(blurred_shifted((row + 5) % 17, (column + 9) % 24) == Approx(before).margin(1e-6));
    }
  }
}

}  // namespace heightlight
