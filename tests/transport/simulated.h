#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "base/texel_algebra.h"
#include "heightlight/transport.h"

namespace heightlight {

/// What is left of systems when they are solved, as a share of the source: stored links are doubles, walks
/// read floats.
constexpr double kLinkResidual = 1e-8;
constexpr double kWalkResidual = 1e-6;

/// A way of finding visibility.
struct Finder {
  const char* name;
  std::function<std::unique_ptr<Transport>(const Surface&)> find;
  double residual = kLinkResidual;
  bool steady = true;  ///< one F takes each bounce to the next, so that what is left can be solved for
};

inline Finder by_rays(int rays, std::uint64_t seed = 1) {
  return {
      "rays", [=](const Surface& surface) {
        return std::make_unique<FormFactors>(build_form_factors(surface, {.rays = rays, .seed = seed}, {}));
      }};
}

/// Along 64 azimuths for the sky, 32 for gathers. Up to half their samples per octave, in texels, walks see
/// all of the surface; beyond it they meet the rows or the columns only, and from four times the samples per
/// octave on blocks.
inline Finder by_horizon_walks(int samples_per_octave = 32) {
  return {
      "horizon walks",
      [=](const Surface& surface) {
        return build_horizon_transport(
            surface,
            {.sky = {.walk = {.azimuths = 64, .samples_per_octave = samples_per_octave, .peak_share = 0.3F}},
             .gather = {.walk = {.azimuths = 32, .samples_per_octave = 32, .peak_share = 0.3F}}});
      },
      kWalkResidual, false};
}

/// Horizon walks whose bounces all look along the same azimuths, so that one F takes each to the next: what
/// is true of operators must be true of it to the last digits.
class SteadyWalks : public Transport {
 public:
  explicit SteadyWalks(std::unique_ptr<Transport> walks) : walks_(std::move(walks)) {
    ambient_occlusion = walks_->ambient_occlusion;
    sky_view_factor = walks_->sky_view_factor;
    direct = walks_->direct;
  }

  TexelVector gather(const TexelVector& x) const override { return walks_->gather(x); }
  TexelVector surface_share() const override { return walks_->surface_share(); }
  Totals solve(const std::vector<IrradianceSystem>& systems, const Watch& watch) const override {
    return walks_->solve(systems, watch);
  }
  std::uint64_t link_count() const override { return walks_->link_count(); }
  std::uint64_t bytes() const override { return walks_->bytes(); }

 private:
  std::unique_ptr<Transport> walks_;
};

inline Finder by_steady_walks(int samples_per_octave = 32) {
  return {"steady horizon walks",
          [walks = by_horizon_walks(samples_per_octave)](const Surface& surface) {
            return std::make_unique<SteadyWalks>(walks.find(surface));
          },
          kWalkResidual};
}

/// For small maps: a hundred microseconds and some hundred links per receiver.
inline Finder by_exact_slices(int azimuths) {
  return {"exact slices", [=](const Surface& surface) {
            return std::make_unique<FormFactors>(build_exact_form_factors(surface, azimuths, {}));
          }};
}

/// A surface with everything that is known of the light on it: what tests of transport start from.
struct Simulated {
  Surface surface;
  std::unique_ptr<Transport> transport;
  std::vector<TexelVector> bounces;  ///< E_b/π at ρ = 1, b = 0 … K
  BounceSeries series;
  Equilibrium tail;  ///< at ρ = 1; from conservation where walks turn from bounce to bounce
  double residual;   ///< to which systems are solved

  Simulated(Heightmap map, const Finder& finder, int last_bounce)
      : surface(build_surface(std::move(map))), transport(finder.find(surface)), residual(finder.residual) {
    const auto keep = [&](int, const TexelVector& irradiance) { bounces.push_back(irradiance); };
    series = bounce(*transport, surface, last_bounce, keep);
    if (finder.steady) {
      tail = solve_tail(*transport, series, 1);
    } else {
      tail.irradiance = conserve_tail(*transport, series.sum, series.last, last_bounce, 1);
    }
  }
  Simulated(const Simulated&) = delete;  // the transport may refer to the surface
  Simulated& operator=(const Simulated&) = delete;
};

inline Simulated simulate_map(Heightmap map, const Finder& finder, int last_bounce = 20) {
  return Simulated(std::move(map), finder, last_bounce);
}

/// By rays.
inline Simulated simulate_map(Heightmap map, int rays, int last_bounce = 20, std::uint64_t seed = 1) {
  return Simulated(std::move(map), by_rays(rays, seed), last_bounce);
}

/// E/π of all bounces under the sky, at an albedo that is the same everywhere.
inline TexelVector total_of(const Transport& transport, double albedo) {
  return std::move(transport.solve({{.albedo = albedo}}, {}).irradiance[0]);
}

/// Σ_{b ≤ last} ρ^b E_b.
inline TexelVector sum_of_bounces(const Simulated& simulated, double albedo, int last) {
  TexelVector sum(simulated.bounces[0].size(), 0);
  double power = 1;
  for (int b = 0; b <= last; ++b) {
    as_eigen(sum) += power * as_eigen(simulated.bounces[static_cast<std::size_t>(b)]);
    power *= albedo;
  }
  return sum;
}

}  // namespace heightlight
