#include <algorithm>
#include <cmath>
#include <optional>

#include "base/stopwatch.h"
#include "base/texel_algebra.h"
#include "heightlight/closed_forms.h"
#include "solve/solver.h"
#include "transport/bounce_check.h"

namespace heightlight {
namespace {

/// What is left after the last bounce at ρ = 1: solved for where links are stored, from conservation where
/// each bounce walks otherwise.
Equilibrium find_tail(const Task& task, const Transport& transport, const BounceSeries& series) {
  const bool walks = task.request.accuracy.visibility == Visibility::horizon_walks;
  if (!walks) return solve_tail(transport, series, 1, task.request.watch);
  return {.irradiance = conserve_tail(transport, series.sum, series.last, series.bounces, 1)};
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
    if (task.request.checks.bounces) {
      Stopwatch watch;
      check_.emplace(task.surface, transport.direct, task.request.accuracy.seed, task.request.watch);
      checked_ += watch.lap();
    }
    if (sink()) timed([&] { sink()->take_sky(transport.ambient_occlusion, transport.sky_view_factor); });
  }

  void take(int b, const TexelVector& irradiance) {
    if (check_) {
      Stopwatch watch;
      results_.evidence.bounce_rmse.push_back(check_->take(irradiance));
      checked_ += watch.lap();
    }
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
  double seconds_of_checks() const { return checked_; }

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
  std::optional<BounceCheck> check_;
  double checked_ = 0;
};

}  // namespace

double deep_seen(const Transport& transport, const TexelVector& at_seen_albedo) {
  SeenMoments moments;
  for (std::size_t i = 0; i < at_seen_albedo.size(); ++i) {
    const SkyViewFactor<double> sky(double{transport.sky_view_factor.values[i]});
    if (!std::isnan(sky.value)) moments.add(sky, seen_from_total(sky, at_seen_albedo[i], kSeenAlbedo));
  }
  return tune_deep_seen(moments).value;
}

void solve_bounces(const Task& task, const Transport& transport, Results& results) {
  const Request& request = task.request;
  Evidence& evidence = results.evidence;
  Recipient recipient(task, transport, results);
  const auto visit = [&](int b, const TexelVector& irradiance) { recipient.take(b, irradiance); };
  const BounceSeries series = bounce(transport, task.surface, request.wanted.bounces, visit, request.watch);
  evidence.bounces = request.wanted.bounces;
  Equilibrium tail = find_tail(task, transport, series);
  note_solver(tail.residual, tail.iterations, evidence);
  if (evidence.energy) check_energy(transport, series, tail.irradiance, *evidence.energy);
  recipient.take_tail(std::move(tail.irradiance));
  evidence.seen = recipient.seen();
  evidence.seconds.check += recipient.seconds_of_checks();
  evidence.seconds.bounces -= recipient.seconds_of_checks();
}

}  // namespace heightlight
