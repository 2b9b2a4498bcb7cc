#include "bake/model_map.h"

#include <algorithm>
#include <cmath>

#include "heightlight/forms.h"

namespace heightlight {
namespace {

double rounded(double value, int levels) { return std::round(value * levels) / levels; }

}  // namespace

const std::vector<double>& checked_albedos() {
  static const std::vector<double> kAlbedos{0.2, 0.5, kSeenAlbedo, 0.9};
  return kAlbedos;
}

ModelError judge_model_map(const Map& sky_view_factor, const Map& n, const TexelVector& total,
                           double albedo) {
  ModelError error{.albedo = albedo};
  std::size_t receivers = 0;
  for (std::size_t i = 0; i < n.size(); ++i) {
    if (std::isnan(n.values[i])) continue;
    ++receivers;
    const auto sky = static_cast<double>(sky_view_factor.values[i]);
    const auto own = static_cast<double>(n.values[i]);
    const double truth = total[i];
    const auto squared = [&](double a, double b) {
      return std::pow(bounced_total(SkyViewFactor(a), SeenSkyViewFactor(b), albedo) - truth, 2);
    };
    error.rmse += squared(sky, own);
    error.rmse_16_bits += squared(rounded(sky, 65535), rounded(own, 65535));
    error.rmse_8_bits += squared(rounded(sky, 255), rounded(own, 255));
  }
  for (double* value : {&error.rmse, &error.rmse_16_bits, &error.rmse_8_bits}) {
    *value = receivers > 0 ? std::sqrt(*value / static_cast<double>(receivers)) : 0;
  }
  return error;
}

}  // namespace heightlight
