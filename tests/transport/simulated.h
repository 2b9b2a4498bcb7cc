#pragma once

#include <vector>

#include "heightlight/transport.h"

namespace heightlight {

/// A surface with everything that is known of the light on it: what tests of transport start from.
struct Simulated {
  Surface surface;
  FormFactors form_factors;
  std::vector<TexelVector> bounces;  ///< E_b/π at ρ = 1, b = 0 … K
  BounceSeries series;
  Equilibrium tail;  ///< at ρ = 1
};

inline Simulated simulate_map(Heightmap map, int rays, int last_bounce = 20, std::uint64_t seed = 1) {
  Simulated result;
  result.surface = build_surface(std::move(map));
  result.form_factors = build_form_factors(result.surface, {{rays, seed}});
  const auto keep = [&](int, const TexelVector& irradiance) { result.bounces.push_back(irradiance); };
  result.series = bounce(result.form_factors, result.surface, last_bounce, {}, keep, true);
  result.tail = solve_tail(result.form_factors, result.series, 1);
  return result;
}

/// Σ_{b ≤ last} ρ^b E_b.
inline TexelVector sum_of_bounces(const Simulated& simulated, double albedo, int last) {
  TexelVector sum = TexelVector::Zero(simulated.bounces[0].size());
  double power = 1;
  for (int b = 0; b <= last; ++b) {
    sum += power * simulated.bounces[static_cast<std::size_t>(b)];
    power *= albedo;
  }
  return sum;
}

}  // namespace heightlight
