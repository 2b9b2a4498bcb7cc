#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/hash.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "heightlight/transport.h"

namespace heightlight {
namespace {

constexpr int kMostBounces = 64;

bool is_missing(const Transport& transport, std::size_t i) {
  return std::isnan(transport.sky_view_factor.values[i]);
}

/// ρ^{K+1} T (1 − q)/(1 − ρ q) of one receiver; `power` is ρ^{K+1}. Rounding may leave T a hair below 0.
double conserved(double sum, double last, double albedo, double power) {
  const double left = std::max(0.0, 1 - sum);
  const double ratio = left + last > 0 ? left / (left + last) : 0;
  const double loss = 1 - albedo * ratio;
  return loss > 0 ? power * left * (1 - ratio) / loss : power * left;
}

/// Calls body(i) for all texels, on all threads.
template <class Body>
void for_texels(const Transport& transport, Body&& body) {
  const auto width = static_cast<std::size_t>(transport.sky_view_factor.width);
  parallel_for(transport.sky_view_factor.height, [&](std::int64_t row) {
    const std::size_t begin = static_cast<std::size_t>(row) * width;
    for (std::size_t i = begin; i < begin + width; ++i) body(i);
  });
}

/// Receivers by which convergence is judged: all of a small map, some of a large one.
std::vector<std::size_t> pick_judges(const Transport& transport) {
  constexpr std::size_t kMost = 8192;
  const std::size_t texels = transport.sky_view_factor.size();
  std::vector<std::size_t> judges;
  for (std::size_t i = 0; i < std::min(kMost, texels); ++i) {
    const std::size_t texel = texels <= kMost ? i : scramble(i) % texels;
    if (!is_missing(transport, texel)) judges.push_back(texel);
  }
  return judges;
}

/// RMS over the judges of how bounce `next`, just gathered, changes the total that conservation foretold
/// without it.
double total_change(const std::vector<std::size_t>& judges, const std::vector<float>& sum,
                    const TexelVector& last, const TexelVector& gathered, double albedo, int next) {
  const double power = std::pow(albedo, next);
  double squares = 0;
  for (const std::size_t i : judges) {
    const double so_far = double{sum[i]};
    const double before = conserved(so_far, last[i], albedo, power);
    const double after =
        power * gathered[i] + conserved(so_far + gathered[i], gathered[i], albedo, power * albedo);
    squares += (after - before) * (after - before);
  }
  return judges.empty() ? 0 : std::sqrt(squares / static_cast<double>(judges.size()));
}

}  // namespace

double conserve_tail(double sum, double last, int bounces, double albedo) {
  return conserved(sum, last, albedo, std::pow(albedo, bounces + 1));
}

TexelVector conserve_tail(const Transport& transport, const TexelVector& sum, const TexelVector& last,
                          int bounces, double albedo) {
  const double power = std::pow(albedo, bounces + 1);
  TexelVector tail(sum.size());
  for_texels(transport, [&](std::size_t i) {
    tail[i] = is_missing(transport, i) ? 0 : conserved(sum[i], last[i], albedo, power);
  });
  return tail;
}

TotalIrradiance solve_totals(const Transport& transport, const std::vector<double>& albedos, double tolerance,
                             const Watch& watch) {
  Progress progress("bounces", 0, watch);
  const std::vector<std::size_t> judges = pick_judges(transport);
  TotalIrradiance result;
  result.totals.assign(albedos.size(), transport.direct);
  TexelVector last = transport.direct;
  std::vector<float> sum(last.begin(), last.end());  // only tells what is left, which single precision can
  std::vector<std::size_t> open(albedos.size());     // whose totals go on
  std::iota(open.begin(), open.end(), std::size_t{0});
  while (!open.empty()) {
    progress.throw_if_stopped();
    const int next = ++result.bounces;
    TexelVector gathered = transport.gather(last);
    std::vector<double> changes;
    for (const std::size_t a : open) {
      changes.push_back(total_change(judges, sum, last, gathered, albedos[a], next));
    }
    for_texels(transport, [&](std::size_t i) { sum[i] += static_cast<float>(gathered[i]); });
    last.swap(gathered);
    std::vector<std::size_t> going_on;
    for (std::size_t k = 0; k < open.size(); ++k) {
      const double albedo = albedos[open[k]];
      TexelVector& total = result.totals[open[k]];
      const double power = std::pow(albedo, next);
      const double tail_power = std::pow(albedo, next + 1);
      const bool enough = changes[k] <= tolerance || next == kMostBounces;
      for_texels(transport, [&](std::size_t i) {
        if (is_missing(transport, i)) return;
        total[i] += power * last[i];
        if (enough) total[i] += conserved(double{sum[i]}, last[i], albedo, tail_power);
      });
      if (!enough) going_on.push_back(open[k]);
      if (enough) result.change = std::max(result.change, changes[k]);
    }
    open.swap(going_on);
    progress.add(1);
  }
  return result;
}

}  // namespace heightlight
