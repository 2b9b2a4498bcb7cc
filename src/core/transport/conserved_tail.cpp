#include <algorithm>
#include <cmath>

#include "base/texels.h"
#include "heightlight/transport.h"

namespace heightlight {
namespace {

bool is_missing(const Transport& transport, std::size_t i) {
  return std::isnan(transport.sky_view_factor.values[i]);
}

/// ρ^{K+1} T (1 − q)/(1 − ρ q) of one receiver; `power` is ρ^{K+1}. Rounding may leave T slightly below 0.
double conserved(double sum, double last, double albedo, double power) {
  const double left = std::max(0.0, 1 - sum);
  const double ratio = left + last > 0 ? left / (left + last) : 0;
  const double loss = 1 - albedo * ratio;
  return loss > 0 ? power * left * (1 - ratio) / loss : power * left;
}

}  // namespace

double conserve_tail(double sum, double last, int bounces, double albedo) {
  return conserved(sum, last, albedo, std::pow(albedo, bounces + 1));
}

TexelVector conserve_tail(const Transport& transport, const TexelVector& sum, const TexelVector& last,
                          int bounces, double albedo) {
  const double power = std::pow(albedo, bounces + 1);
  TexelVector tail(sum.size());
  for_texels(transport.sky_view_factor, [&](std::size_t i) {
    tail[i] = is_missing(transport, i) ? 0 : conserved(sum[i], last[i], albedo, power);
  });
  return tail;
}

}  // namespace heightlight
