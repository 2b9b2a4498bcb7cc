#include "cli/solve_bounces.h"

#include <algorithm>
#include <cmath>

#include "heightlight/models.h"

namespace heightlight {
namespace {

/// What is left after the last bounce, at constant albedo: solved for where links are exact, from
/// conservation where they are walked.
Equilibrium find_tail(const Transport& transport, const BounceSeries& series, double albedo,
                      bool by_conservation, bool quiet) {
  if (!by_conservation) return solve_tail(transport, series, albedo, quiet);
  return {conserve_tail(transport, series.sum, series.last, series.bounces, albedo), 0, 0};
}

/// t, from what is seen at kSeenAlbedo, the last of the series' albedos.
double find_deep_seen(const Transport& transport, const BounceSeries& series) {
  SeenMoments moments;
  for (Eigen::Index i = 0; i < series.sum.size(); ++i) {
    const SkyViewFactor<double> sky(double{transport.sky_view_factor.values[static_cast<std::size_t>(i)]});
    if (std::isnan(sky.value)) continue;
    const double total =
        series.weighted.back()[i] + conserve_tail(series.sum[i], series.last[i], series.bounces, kSeenAlbedo);
    moments.add(sky, seen_from_total(sky, total, kSeenAlbedo));
  }
  return tune_deep_seen(moments).value;
}

/// Total irradiance of all bounces, one vector per channel of the albedo.
std::vector<TexelVector> find_totals(const Transport& transport, const BounceSeries& series,
                                     const Albedo& albedo, bool by_conservation, EnergyCheck& energy,
                                     bool quiet) {
  std::vector<TexelVector> totals;
  const auto note = [&energy](const Equilibrium& solved) {
    energy.solver_residual = std::max(energy.solver_residual, solved.residual);
    energy.solver_iterations = std::max(energy.solver_iterations, solved.iterations);
  };
  for (std::size_t channel = 0; channel < albedo.constant.size(); ++channel) {
    const Equilibrium tail = find_tail(transport, series, albedo.constant[channel], by_conservation, quiet);
    note(tail);
    totals.push_back(series.weighted[channel] + tail.irradiance);
  }
  for (const TexelVector& reflectance : albedo.varying) {
    const Equilibrium all =
        solve_equilibrium(transport, transport.direct, reflectance, transport.direct, quiet);
    note(all);
    totals.push_back(all.irradiance);
  }
  return totals;
}

/// Compares E₀ + … + E_K + tail with 1. (A tail from conservation is taken from that sum; the rows are
/// checked then.)
void check_energy(const Transport& transport, const BounceSeries& series, const Equilibrium& tail,
                  EnergyCheck& energy) {
  energy.spectral_radius = series.spectral_radius;
  energy.solver_residual = tail.residual;
  energy.solver_iterations = tail.iterations;
  double sum = 0;
  double tail_sum = 0;
  std::size_t receivers = 0;
  for (Eigen::Index i = 0; i < series.sum.size(); ++i) {
    if (std::isnan(transport.sky_view_factor.values[static_cast<std::size_t>(i)])) continue;
    const double total = series.sum[i] + tail.irradiance[i];
    energy.sum_max_error = std::max(energy.sum_max_error, std::fabs(total - 1));
    energy.tail_max = std::max(energy.tail_max, tail.irradiance[i]);
    sum += total;
    tail_sum += tail.irradiance[i];
    ++receivers;
  }
  energy.mean_total_over_pi = sum / static_cast<double>(receivers);
  energy.tail_mean = tail_sum / static_cast<double>(receivers);
}

}  // namespace

SolvedBounces solve_bounces(const Transport& transport, const Surface& surface, const Albedo& albedo,
                            const SimulateOptions& options, bool by_conservation, BounceSink& sink,
                            EnergyCheck& energy) {
  const bool quiet = options.run.quiet;
  const auto visit = [&sink](int b, const TexelVector& irradiance) { sink.take(b, irradiance); };
  std::vector<double> albedos = albedo.constant;
  albedos.push_back(kSeenAlbedo);
  const BounceSeries series = bounce(transport, surface, options.bounces, albedos, visit, quiet);
  const Equilibrium tail = find_tail(transport, series, 1, by_conservation, quiet);
  check_energy(transport, series, tail, energy);
  sink.take_tail(tail.irradiance);
  return {tail.irradiance, find_totals(transport, series, albedo, by_conservation, energy, quiet),
          find_deep_seen(transport, series)};
}

}  // namespace heightlight
