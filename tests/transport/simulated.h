#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "base/texel_algebra.h"
#include "heightlight/transport.h"

namespace heightlight {

/// A way of finding visibility.
struct Finder {
  const char* name;
  std::function<std::unique_ptr<Transport>(const Surface&)> find;
};

inline Finder by_rays(int rays, std::uint64_t seed = 1) {
  return {
      "rays", [=](const Surface& surface) {
        return std::make_unique<FormFactors>(build_form_factors(surface, {.rays = rays, .seed = seed}, {}));
      }};
}

/// Along 64 azimuths for the sky, 32 for links. Up to a quarter of their fineness, in texels, walks see all
/// of the surface; beyond it they meet the rows or the columns only, and from twice the fineness on blocks.
inline Finder by_horizon_walks(int fineness = 32) {
  return {"horizon walks", [=](const Surface& surface) {
            return build_horizon_transport(
                surface,
                {.sky = {.walk = {.azimuths = 64, .fineness = fineness, .peak_share = 0.3F}},
                 .links = {.walk = {.azimuths = 32, .fineness = 32, .peak_share = 0.3F}}},
                {});
          }};
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
  Equilibrium tail;  ///< at ρ = 1

  Simulated(Heightmap map, const Finder& finder, int last_bounce)
      : surface(build_surface(std::move(map))), transport(finder.find(surface)) {
    const auto keep = [&](int, const TexelVector& irradiance) { bounces.push_back(irradiance); };
    series = bounce(*transport, surface, last_bounce, {}, keep);
    tail = solve_tail(*transport, series, 1);
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
