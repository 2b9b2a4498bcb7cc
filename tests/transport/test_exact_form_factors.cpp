#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "base/parallel.h"
#include "heightlight/error.h"
#include "heightlight/transport.h"
#include "test_maps.h"
#include "transport/exact_gather.h"
#include "transport/root_mean_square.h"

namespace heightlight {
namespace {

TexelVector total_at(const Transport& transport, double albedo) {
  const TexelVector reflectance(transport.direct.size(), albedo);
  return solve_equilibrium(transport, transport.direct, reflectance, transport.direct).irradiance;
}

TEST_CASE("sky + links = 1 in every row of exact slices", "[transport][exact]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const double missing = GENERATE(0.0, 0.3);
  const auto [width, height] =
      GENERATE(std::pair{24, 19}, std::pair{1, 17}, std::pair{9, 1}, std::pair{1, 1});
  const int azimuths = GENERATE(2, 32);
  const Surface surface = build_surface(make_rough_map(width, height, boundary, 0.3, missing, 4));
  const FormFactors exact = build_exact_form_factors(surface, azimuths, {});
  CHECK(row_sum_error(exact).largest < 1e-12);  // identity: n·ε of a few hundred links
  CHECK(exact.ray_weights.empty());
}

TEST_CASE("exact slices give the total that rays give", "[transport][exact][slow]") {
  const double relief = GENERATE(0.1, 0.3);
  const Surface surface = build_surface(make_synth_map("brick", 48, Boundary::tile, relief));
  const FormFactors rays = build_form_factors(surface, {.rays = 2048, .seed = 1}, {});
  const FormFactors exact = build_exact_form_factors(surface, 64, {});
  const double sky_error = rms(as_eigen(exact.direct) - as_eigen(rays.direct));
  const TexelVector of_exact = total_at(exact, 0.8);
  const TexelVector of_rays = total_at(rays, 0.8);
  const TexelVector difference = to_texels(as_eigen(of_exact) - as_eigen(of_rays));
  const double mean = as_eigen(difference).mean();
  INFO("A " << sky_error << ", total " << rms(difference) << ", mean " << mean);
  // Monte Carlo: the rays' A errs by 1.3e-3, their total by 4e-4. Discretisation: on steep walls a vertex's
  // own facets hide what its smooth normal faces, for which rays and slices take places of their own
  // (measured: 9e-4 and a mean of 4e-4 at relief 0.3)
  CHECK(sky_error < 2.5e-3);
  CHECK(rms(difference) < 1.5e-3);
  CHECK(std::fabs(mean) < 6e-4);
}

TEST_CASE("gathers over stored slices are those over the slices themselves, but for places in steps of 1/255",
          "[transport][exact]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const Surface surface = build_surface(make_synth_map("sines", 48, boundary, 0.3));
  const FormFactors exact = build_exact_form_factors(surface, 16, {});
  TexelVector x(48 * 48);
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = std::sin(0.3 * static_cast<double>(i % 48)) * std::cos(0.2 * static_cast<double>(i / 48));
  }
  const TexelVector gathered = gather(exact, x);
  const ExactWalker walker(surface, 16);
  SliceView view;
  for (std::size_t texel = 0; texel < 48 * 48; texel += 5) {
    walker.view(static_cast<int>(texel) / 48, static_cast<int>(texel) % 48, view);
    // rounding: half a step of 1/255 in two coordinates, of a field that changes by 0.3 per texel
    const double expected = gather_exactly(view, surface, [&](std::size_t i) { return x[i]; });
    REQUIRE(gathered[texel] == Approx(expected).margin(0.3 / 255));
    REQUIRE(exact.direct[texel] == view.sky_view_factor);
  }
}

TEST_CASE("exact slices do not depend on the number of threads", "[transport][exact]") {
  const Surface surface = build_surface(make_rough_map(33, 21, Boundary::tile, 0.3, 0.1, 6));
  const ThreadScope one_thread(1);
  const FormFactors one = build_exact_form_factors(surface, 16, {});
  const TexelVector total = total_at(one, 0.9);
  for (const int threads : {2, 7}) {
    const ThreadScope more_threads(threads);
    const FormFactors other = build_exact_form_factors(surface, 16, {});
    CHECK(other.direct == one.direct);
    CHECK(total_at(other, 0.9) == total);
  }
}

TEST_CASE("exact links that would not fit are refused before they are made, and bad azimuths",
          "[transport][exact]") {
  const Surface surface = build_surface(make_synth_map("brick", 64, Boundary::tile, 0.3));
  try {
    build_exact_form_factors(surface, 64, {.memory = 100'000});
    FAIL("nothing was refused");
  } catch (const MemoryError& error) {
    CHECK(error.remedy == "memory");
    CHECK_THAT(error.what(), Catch::Contains("97.7 KiB"));
  }
  for (const int azimuths : {-2, 0, 1, 7, 65538}) {
    CHECK_THROWS_AS(build_exact_form_factors(surface, azimuths, {}), UsageError);
  }
}

}  // namespace
}  // namespace heightlight
