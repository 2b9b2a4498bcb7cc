#include <algorithm>
#include <cmath>

#include "core/progress.h"
#include "heightlight/transport.h"

namespace heightlight {
namespace {

constexpr int kMostBounces = 64;

bool is_missing(const Transport& transport, Eigen::Index i) {
  return std::isnan(transport.sky_view_factor.values[static_cast<std::size_t>(i)]);
}

/// ρ^{K+1} T (1 − q)/(1 − ρ q) of one receiver; `power` is ρ^{K+1}. Rounding may leave T a hair below 0.
double conserved(double sum, double last, double albedo, double power) {
  const double left = std::max(0.0, 1 - sum);
  const double ratio = left + last > 0 ? left / (left + last) : 0;
  const double loss = 1 - albedo * ratio;
  return loss > 0 ? power * left * (1 - ratio) / loss : power * left;
}

}  // namespace

TexelVector conserve_tail(const Transport& transport, const TexelVector& sum, const TexelVector& last,
                          int bounces, double albedo) {
  const double power = std::pow(albedo, bounces + 1);
  TexelVector tail(sum.size());
  for (Eigen::Index i = 0; i < sum.size(); ++i) {
    tail[i] = is_missing(transport, i) ? 0 : conserved(sum[i], last[i], albedo, power);
  }
  return tail;
}

TotalIrradiance solve_totals(const Transport& transport, const std::vector<double>& albedos, double tolerance,
                             bool quiet) {
  Progress progress("bounces", 0, quiet);
  TexelVector last = transport.direct;
  TexelVector sum = last;
  TotalIrradiance result;
  std::vector<TexelVector> weighted(albedos.size(), last);
  double receivers = 0;
  for (Eigen::Index i = 0; i < sum.size(); ++i) receivers += is_missing(transport, i) ? 0 : 1;
  for (result.bounces = 0;; ++result.bounces) {
    // The totals as they would be without and with the bounce at hand: their difference tells when to stop.
    result.change = 0;
    const int next = result.bounces + 1;
    TexelVector gathered = transport.gather(last);
    for (std::size_t a = 0; a < albedos.size(); ++a) {
      const double power = std::pow(albedos[a], next);
      double squares = 0;
      for (Eigen::Index i = 0; i < sum.size(); ++i) {
        if (is_missing(transport, i)) continue;
        const double before = conserved(sum[i], last[i], albedos[a], power);
        const double after = power * gathered[i] +
                             conserved(sum[i] + gathered[i], gathered[i], albedos[a], power * albedos[a]);
        squares += (after - before) * (after - before);
        weighted[a][i] += power * gathered[i];
      }
      result.change = std::max(result.change, receivers > 0 ? std::sqrt(squares / receivers) : 0);
    }
    sum += gathered;
    last.swap(gathered);
    progress.add(1);
    if (result.change <= tolerance || next == kMostBounces) {
      result.bounces = next;
      break;
    }
  }
  for (std::size_t a = 0; a < albedos.size(); ++a) {
    const double power = std::pow(albedos[a], result.bounces + 1);
    for (Eigen::Index i = 0; i < sum.size(); ++i) {
      if (!is_missing(transport, i)) weighted[a][i] += conserved(sum[i], last[i], albedos[a], power);
    }
  }
  result.totals = std::move(weighted);
  return result;
}

}  // namespace heightlight
