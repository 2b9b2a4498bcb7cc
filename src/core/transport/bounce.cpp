#include <cmath>
#include <limits>

#include "base/progress.h"
#include "base/texel_algebra.h"
#include "heightlight/transport.h"

namespace heightlight {
namespace {

constexpr double kRounding = 1e-12;

/// ⟨a, b⟩ with every texel weighted by its area. Reciprocity, area_i F_ij = area_j F_ji, makes F symmetric
/// under this product.
double area_product(const TexelVector& a, const TexelVector& b, const Surface& surface) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const float up = surface.normal.values[i].z;
    if (!std::isnan(up)) sum += a[i] * b[i] / up;
  }
  return sum;
}

}  // namespace

BounceSeries bounce(const Transport& transport, const Surface& surface, int bounces,
                    const std::function<void(int, const TexelVector&)>& visit, const Watch& watch) {
  Progress progress("bounces", bounces + 1, watch);
  const std::unique_ptr<BounceSequence> sequence = transport.start_bounces();
  BounceSeries series;
  series.bounces = bounces;
  TexelVector last = transport.direct;
  series.sum = last;
  visit(0, last);
  for (int b = 1; b <= bounces; ++b) {
    progress.throw_if_stopped();
    last = sequence->next(last, series.sum);
    // No more than is left: walks that turn from bounce to bounce might find more, by their noise. (What is
    // left is known to within a few ε.)
    const auto left = (1 - as_eigen(series.sum).array()).max(0.0) + kRounding;
    as_eigen(last) = as_eigen(last).array().min(left).matrix();
    as_eigen(series.sum) += as_eigen(last);
    visit(b, last);
    progress.add(1);
  }
  series.last = last;
  series.next = sequence->next(last, series.sum);
  const double length = area_product(last, last, surface);
  series.spectral_radius = length > 0 ? area_product(last, series.next, surface) / length : 0;
  return series;
}

Map to_map(const TexelVector& values, const Surface& surface) {
  Map map(surface.width(), surface.height());
  for (std::size_t i = 0; i < map.size(); ++i) {
    const bool missing = std::isnan(surface.map.height.values[i]);
    map.values[i] = missing ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(values[i]);
  }
  return map;
}

}  // namespace heightlight
