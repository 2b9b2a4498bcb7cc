#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "heightlight/solve.h"

namespace heightlight {

/// Albedos that the promise is held to.
constexpr std::array<double, 3> kPromisedAlbedos{0.3, 0.8, 0.95};

/// What the error wanted came to on one map: against exact slices, and by the solution's own check.
struct Promise {
  double sky = 0;       ///< RMSE of A, reached
  double sky_said = 0;  ///< as the check has it
  std::array<double, kPromisedAlbedos.size()> total{};
  std::array<double, kPromisedAlbedos.size()> total_said{};
  bool told = false;  ///< that something was missed

  /// The most that anything errs by.
  double worst() const { return std::max(sky, *std::max_element(total.begin(), total.end())); }
};

template <class Values, class Other>
double rms_between(const Values& a, const Other& b) {
  double squares = 0;
  double count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = double{a[i]} - double{b[i]};
    if (std::isnan(difference)) continue;
    squares += difference * difference;
    ++count;
  }
  return count > 0 ? std::sqrt(squares / count) : 0;
}

/// Solves by walks for an error, and by exact slices along `azimuths`.
inline Promise try_promise(const Surface& surface, double error, std::uint64_t seed, int azimuths) {
  Request request;
  request.wanted.sky = true;
  for (const double albedo : kPromisedAlbedos) request.wanted.totals.push_back({.constant = {albedo}});
  request.accuracy.error = error;
  request.accuracy.seed = seed;
  const Results walked = solve(surface, request);
  request.accuracy.visibility = Visibility::exact_slices;
  request.accuracy.azimuths = azimuths;
  request.checks = {.sky = false, .totals = false, .energy = false, .bounces = false};
  const Results exact = solve(surface, request);
  Promise promise{.sky = rms_between(walked.sky_view_factor.values, exact.sky_view_factor.values)};
  promise.sky_said = walked.evidence.sky_rmse.value_or(0);
  for (std::size_t t = 0; t < kPromisedAlbedos.size(); ++t) {
    promise.total[t] = rms_between(walked.totals[t][0], exact.totals[t][0]);
    promise.total_said[t] = walked.evidence.total_checks[t].total_rmse;
  }
  promise.told = !missed_error(walked.evidence).empty();
  return promise;
}

}  // namespace heightlight
