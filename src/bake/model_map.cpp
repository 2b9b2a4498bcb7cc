#include "bake/model_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "heightlight/models.h"

namespace heightlight {
namespace {

double rounded(double value, int levels) { return std::round(value * levels) / levels; }

}  // namespace

const std::vector<double>& checked_albedos() {
  static const std::vector<double> kAlbedos{0.2, 0.5, kSeenAlbedo, 0.9};
  return kAlbedos;
}

Map fit_model_map(const Map& sky_view_factor, const TexelVector& total) {
  Map n(sky_view_factor.width, sky_view_factor.height);
  parallel_for(n.height, [&](std::int64_t row) {
    const std::size_t begin = n.index(static_cast<int>(row), 0);
    for (std::size_t i = begin; i < begin + static_cast<std::size_t>(n.width); ++i) {
      const auto sky = static_cast<double>(sky_view_factor.values[i]);
      n.values[i] = std::isnan(sky)
                        ? std::numeric_limits<float>::quiet_NaN()
                        : static_cast<float>(seen_from_total(SkyViewFactor(sky),
                                                             total[static_cast<Eigen::Index>(i)], kSeenAlbedo)
                                                 .value);
    }
  });
  return n;
}

ModelError judge_model_map(const Map& sky_view_factor, const Map& n, const TexelVector& total,
                           double albedo) {
  ModelError error{albedo};
  std::size_t receivers = 0;
  for (std::size_t i = 0; i < n.size(); ++i) {
    if (std::isnan(n.values[i])) continue;
    ++receivers;
    const auto sky = static_cast<double>(sky_view_factor.values[i]);
    const auto own = static_cast<double>(n.values[i]);
    const double truth = total[static_cast<Eigen::Index>(i)];
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

const char* model_shader_glsl() {
  return "// Irradiance of all bounces over that of an open place, under an even sky, at any albedo.\n"
         "// a_n: the texture's two channels, A and n, linear. albedo: linear reflectance, per channel.\n"
         "vec3 multi_bounce(vec2 a_n, vec3 albedo) {\n"
         "  vec3 loss = max(1.0 - albedo * (1.0 - a_n.y), 1e-4);\n"
         "  return a_n.x + albedo * (1.0 - a_n.x) * a_n.y / loss;\n"
         "}\n";
}

const char* model_shader_hlsl() {
  return "// Irradiance of all bounces over that of an open place, under an even sky, at any albedo.\n"
         "// a_n: the texture's two channels, A and n, linear. albedo: linear reflectance, per channel.\n"
         "float3 multi_bounce(float2 a_n, float3 albedo) {\n"
         "  float3 loss = max(1.0 - albedo * (1.0 - a_n.y), 1e-4);\n"
         "  return a_n.x + albedo * (1.0 - a_n.x) * a_n.y / loss;\n"
         "}\n";
}

}  // namespace heightlight
