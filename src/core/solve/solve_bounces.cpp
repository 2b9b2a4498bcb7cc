#include <algorithm>
#include <cmath>

#include "base/stopwatch.h"
#include "base/texel_algebra.h"
#include "heightlight/closed_forms.h"
#include "solve/solver.h"

namespace heightlight {
namespace {

/// Of the error wanted, what ending the bounces may take.
constexpr double kBounceShare = 0.2;

/// What is left after the last bounce, at constant albedo: solved for where links are exact, from
/// conservation where they are walked.
Equilibrium find_tail(const Task& task, const Transport& transport, const BounceSeries& series,
                      double albedo) {
  const bool walks = task.request.accuracy.visibility == Visibility::horizon_walks;
  if (!walks) return solve_tail(transport, series, albedo, task.request.watch);
  return {.irradiance = conserve_tail(transport, series.sum, series.last, series.bounces, albedo)};
}

/// E/π of all bounces at kSeenAlbedo, the last of the series' albedos.
TexelVector seen_total(const Transport& transport, const BounceSeries& series) {
  TexelVector total = series.weighted.back();
  as_eigen(total) += as_eigen(conserve_tail(transport, series.sum, series.last, series.bounces, kSeenAlbedo));
  return total;
}

/// t, from what is seen at kSeenAlbedo.
double find_deep_seen(const Map& sky_view_factor, const TexelVector& total) {
  SeenMoments moments;
  for (std::size_t i = 0; i < total.size(); ++i) {
    const SkyViewFactor<double> sky(double{sky_view_factor.values[i]});
    if (!std::isnan(sky.value)) moments.add(sky, seen_from_total(sky, total[i], kSeenAlbedo));
  }
  return tune_deep_seen(moments).value;
}

void note_solution(const Equilibrium& solved, Evidence& evidence) {
  if (!evidence.energy) return;
  EnergyCheck& energy = *evidence.energy;
  energy.solver_residual = std::max(energy.solver_residual, solved.residual);
  energy.solver_iterations = std::max(energy.solver_iterations, solved.iterations);
}

/// Compares E₀ + … + E_K + tail with 1. (A tail from conservation is taken from that sum; the rows are
/// checked then.)
void check_energy(const Transport& transport, const BounceSeries& series, const TexelVector& tail,
                  EnergyCheck& energy) {
  energy.spectral_radius = series.spectral_radius;
  double sum = 0;
  double tail_sum = 0;
  std::size_t receivers = 0;
  for (std::size_t i = 0; i < series.sum.size(); ++i) {
    if (std::isnan(transport.sky_view_factor.values[i])) continue;
    const double total = series.sum[i] + tail[i];
    energy.sum_max_error = std::max(energy.sum_max_error, std::fabs(total - 1));
    energy.tail_max = std::max(energy.tail_max, tail[i]);
    sum += total;
    tail_sum += tail[i];
    ++receivers;
  }
  energy.mean_total_over_pi = sum / static_cast<double>(receivers);
  energy.tail_mean = tail_sum / static_cast<double>(receivers);
}

/// Hands bounces on, and takes the time of whoever takes them.
class Recipient {
 public:
  Recipient(const Task& task, const Transport& transport, Results& results)
      : task_(task), transport_(transport), results_(results) {
    seen_.expected = expected_seen(transport.sky_view_factor, task.surface).value;
    if (sink()) timed([&] { sink()->take_sky(transport.ambient_occlusion, transport.sky_view_factor); });
  }

  void take(int b, const TexelVector& irradiance) {
    if (b == 1) seen_.mean = measured_seen(transport_.sky_view_factor, irradiance, task_.surface).value;
    if (sink()) {
      timed([&] { sink()->take_bounce(b, irradiance); });
    } else {
      results_.bounces.push_back(irradiance);
    }
  }

  void take_tail(TexelVector tail) {
    if (sink()) {
      timed([&] { sink()->take_tail(tail); });
    } else {
      results_.tail = std::move(tail);
    }
  }

  const SeenSky& seen() const { return seen_; }

 private:
  BounceSink* sink() const { return task_.request.sink; }

  template <class Work>
  void timed(Work&& work) {
    Stopwatch watch;
    work();
    results_.evidence.seconds.sink += watch.lap();
  }

  const Task& task_;
  const Transport& transport_;
  Results& results_;
  SeenSky seen_;
};

/// Constant albedos whose totals follow from bounces, in the order of the request's channels.
std::vector<double> constant_albedos(const Wanted& wanted) {
  std::vector<double> albedos;
  for (const Albedo& albedo : wanted.totals) {
    if (!follows_from_bounces(wanted, albedo)) continue;
    albedos.insert(albedos.end(), albedo.constant.begin(), albedo.constant.end());
  }
  return albedos;
}

/// Puts `found`, one total per constant albedo in that order, where they belong, and solves for the rest.
void place_totals(const Task& task, const Transport& transport, std::vector<TexelVector> found,
                  Results& results) {
  const Wanted& wanted = task.request.wanted;
  auto next = found.begin();
  for (const Albedo& albedo : wanted.totals) {
    if (!follows_from_bounces(wanted, albedo)) {
      results.totals.push_back(solve_albedo(task, transport, albedo, results));
      continue;
    }
    std::vector<TexelVector>& channels = results.totals.emplace_back();
    for (std::size_t c = 0; c < albedo.constant.size(); ++c) channels.push_back(std::move(*next++));
  }
}

}  // namespace

std::vector<TexelVector> solve_albedo(const Task& task, const Transport& transport, const Albedo& albedo,
                                      Results& results) {
  const TexelVector& own = task.request.wanted.direct;
  const TexelVector& direct = own.empty() ? transport.direct : own;
  std::vector<TexelVector> channels;
  const auto solve_one = [&](const TexelVector& reflectance) {
    Equilibrium solved = solve_equilibrium(transport, direct, reflectance, direct, task.request.watch);
    note_solution(solved, results.evidence);
    channels.push_back(std::move(solved.irradiance));
  };
  for (const double constant : albedo.constant) solve_one(TexelVector(direct.size(), constant));
  for (const TexelVector& reflectance : albedo.varying) solve_one(reflectance);
  return channels;
}

void solve_bounces(const Task& task, const Transport& transport, Results& results) {
  const Request& request = task.request;
  Evidence& evidence = results.evidence;
  Recipient recipient(task, transport, results);
  std::vector<double> albedos = constant_albedos(request.wanted);
  albedos.push_back(kSeenAlbedo);
  const auto visit = [&](int b, const TexelVector& irradiance) { recipient.take(b, irradiance); };
  BounceSeries series =
      bounce(transport, task.surface, request.wanted.bounces, albedos, visit, request.watch);
  evidence.bounces = request.wanted.bounces;
  Equilibrium tail = find_tail(task, transport, series, 1);
  note_solution(tail, evidence);
  if (evidence.energy) check_energy(transport, series, tail.irradiance, *evidence.energy);
  recipient.take_tail(std::move(tail.irradiance));
  std::vector<TexelVector> totals;
  for (std::size_t i = 0; i + 1 < albedos.size(); ++i) {
    const Equilibrium rest = find_tail(task, transport, series, albedos[i]);
    note_solution(rest, evidence);
    as_eigen(series.weighted[i]) += as_eigen(rest.irradiance);
    totals.push_back(std::move(series.weighted[i]));
  }
  place_totals(task, transport, std::move(totals), results);
  const TexelVector at_seen_albedo = seen_total(transport, series);
  if (request.wanted.seen) results.seen = solve_seen(transport.sky_view_factor, at_seen_albedo);
  evidence.seen = recipient.seen();
  evidence.seen->deep = find_deep_seen(transport.sky_view_factor, at_seen_albedo);
}

void solve_totals_only(const Task& task, const Transport& transport, Results& results) {
  const Request& request = task.request;
  std::vector<double> albedos = constant_albedos(request.wanted);
  auto at_seen = std::find(albedos.begin(), albedos.end(), kSeenAlbedo);
  if (request.wanted.seen && at_seen == albedos.end()) {
    albedos.push_back(kSeenAlbedo);
    at_seen = albedos.end() - 1;
  }
  std::vector<TexelVector> totals;
  if (!albedos.empty()) {
    TotalIrradiance solved =
        solve_totals(transport, albedos, kBounceShare * request.accuracy.error, request.watch);
    results.evidence.bounces = solved.bounces;
    totals = std::move(solved.totals);
  }
  if (request.wanted.seen) {
    results.seen =
        solve_seen(transport.sky_view_factor, totals[static_cast<std::size_t>(at_seen - albedos.begin())]);
  }
  place_totals(task, transport, std::move(totals), results);
}

}  // namespace heightlight
