#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "heightlight/closed_forms.h"
#include "stability/hard_maps.h"
#include "transport/simulated.h"

// Closed forms on what the hard maps hold: what is proven of them for any surface holds there too.

namespace heightlight {
namespace {

TexelVector total_at(const Simulated& simulated, double albedo) {
  const Transport& transport = *simulated.transport;
  const TexelVector reflectance(transport.direct.size(), albedo);
  return solve_equilibrium(transport, transport.direct, reflectance, transport.direct).irradiance;
}

/// Calls visit(texel, A) for every sample that is there.
template <class Visit>
void for_samples(const Simulated& simulated, Visit&& visit) {
  for (std::size_t i = 0; i < simulated.transport->direct.size(); ++i) {
    if (std::isnan(simulated.surface.map.height.values[i])) continue;
    visit(i, SkyViewFactor(simulated.transport->direct[i]));
  }
}

TEST_CASE("on every hard map one total bounds all others, and the n stored gives it back", "[stability]") {
  for (const HardMap& hard : hard_maps()) {
    CAPTURE(hard.name);
    const Simulated simulated = simulate_map(hard.map, by_exact_slices(16), 0);
    const TexelVector stored = total_at(simulated, kSeenAlbedo);
    const double residual = 300 * simulated.residual;
    for (const double albedo : {0.3, 0.9}) {
      const TexelVector total = total_at(simulated, albedo);
      for_samples(simulated, [&](std::size_t i, SkyViewFactor<double> sky) {
        const TotalBounds<double> bounds = bound_total(sky, stored[i], kSeenAlbedo, albedo);
        // The bounds are theorems; the solver's residual in `stored` moves them, by what a power of it
        // does: ten times as far at the bottom of wells, where q^γ is steep.
        CHECK(total[i] >= bounds.low - 10 * residual);
        CHECK(total[i] <= bounds.high + 10 * residual);
        const SeenSkyViewFactor<double> n = seen_from_total(sky, stored[i], kSeenAlbedo);
        const double model = bounced_total(sky, n, albedo);
        CHECK((model >= bounds.low - 1e-12 && model <= bounds.high + 1e-12));  // identity
      });
    }
    for_samples(simulated, [&](std::size_t i, SkyViewFactor<double> sky) {
      const SeenSkyViewFactor<double> n = seen_from_total(sky, stored[i], kSeenAlbedo);
      CHECK(std::fabs(bounced_total(sky, n, kSeenAlbedo) - stored[i]) < 1e-12 + residual);
    });
  }
}

TEST_CASE("on every hard map each closed form is in [0, 1], or says that it is outside its domain",
          "[stability]") {
  for (const HardMap& hard : hard_maps()) {
    const Simulated simulated = simulate_map(hard.map, by_exact_slices(16), 1);
    const Map& sky_view_factor = simulated.transport->sky_view_factor;
    const SeenSkyViewFactor<double> expected = expected_seen(sky_view_factor, simulated.surface);
    const SeenSkyViewFactor<double> measured =
        measured_seen(sky_view_factor, simulated.bounces[1], simulated.surface);
    const Map blurred = blur_seen(sky_view_factor, simulated.surface.tiles());
    INFO(hard.name);
    CHECK((expected.value >= 0 && expected.value <= 1));
    // 1 − A of a map of floats has lost what is below 6e-8, which on nearly level maps is a part of it.
    double missing = 0;
    double count = 0;
    for_samples(simulated, [&](std::size_t, SkyViewFactor<double> sky) {
      missing += 1 - sky.value;
      ++count;
    });
    CHECK((measured.value >= 0 && measured.value * missing <= missing + 6e-8 * count));
    for_samples(simulated, [&](std::size_t i, SkyViewFactor<double> sky) {
      ModelInputs inputs;
      inputs.ambient_occlusion = AmbientOcclusion(double{simulated.transport->ambient_occlusion.values[i]});
      inputs.sky_view_factor = sky;
      inputs.expected_seen = inputs.deep_seen = inputs.seen = expected;
      inputs.blurred = SeenSkyViewFactor(double{blurred.values[i]});
      for (const ClosedForm& form : closed_forms()) {
        CAPTURE(form.name);
        for (const double albedo : {0.0, 0.5, 1 - 1e-7, 1.0}) {
          const std::optional<double> total = form.evaluate(inputs, albedo);
          CHECK((!total || (*total >= 0 && *total <= 1)));
        }
      }
    });
  }
}

}  // namespace
}  // namespace heightlight
