#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "heightlight/closed_forms.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

void check_size(const Map& map, const Surface& surface) {
  if (map.width != surface.width() || map.height != surface.height()) {
    throw Error("a sky view factor of another size than its surface");
  }
}

/// (1 − A)/n_z: how much a texel is seen by the rest of the surface, by its area. 0 where missing.
double seen_weight(const Map& sky_view_factor, const Surface& surface, std::size_t i) {
  const double sky = double{sky_view_factor.values[i]};
  if (std::isnan(sky)) return 0;
  return (1 - clamp_share(sky)) / double{surface.normal.values[i].z};
}

/// Half of a Gaussian, from its middle to 3 σ, not normalized.
std::vector<double> half_kernel(double sigma) {
  std::vector<double> kernel;
  for (int k = 0; k <= static_cast<int>(std::ceil(3 * sigma)); ++k) {
    kernel.push_back(std::exp(-k * k / (2 * sigma * sigma)));
  }
  return kernel;
}

/// Convolves with the kernel along the rows or along the columns.
Image<double> blur_along(const Image<double>& values, const std::vector<double>& kernel, bool along_rows,
                         bool wraps) {
  Image<double> result(values.width, values.height);
  const int length = along_rows ? values.width : values.height;
  const int radius = static_cast<int>(kernel.size()) - 1;
  parallel_for(values.height, [&](std::int64_t i) {
    const int row = static_cast<int>(i);
    for (int column = 0; column < values.width; ++column) {
      const int at = along_rows ? column : row;
      double sum = 0;
      for (int k = -radius; k <= radius; ++k) {
        int near = at + k;
        if (wraps) near = ((near % length) + length) % length;
        if (near < 0 || near >= length) continue;
        sum += kernel[static_cast<std::size_t>(std::abs(k))] *
               (along_rows ? values(row, near) : values(near, column));
      }
      result(row, column) = sum;
    }
  });
  return result;
}

Image<double> blur(const Image<double>& values, const std::vector<double>& kernel, bool wraps) {
  return blur_along(blur_along(values, kernel, true, wraps), kernel, false, wraps);
}

}  // namespace

SeenSkyViewFactor<double> expected_seen(const Map& sky_view_factor, const Surface& surface) {
  check_size(sky_view_factor, surface);
  double sum = 0;
  double weights = 0;
  for (std::size_t i = 0; i < sky_view_factor.size(); ++i) {
    const double weight = seen_weight(sky_view_factor, surface, i);
    if (weight == 0) continue;
    sum += weight * clamp_share(double{sky_view_factor.values[i]});
    weights += weight;
  }
  return SeenSkyViewFactor<double>(weights > 0 ? sum / weights : 1);
}

SeenSkyViewFactor<double> measured_seen(const Map& sky_view_factor, const TexelVector& first_bounce,
                                        const Surface& surface) {
  check_size(sky_view_factor, surface);
  double sum = 0;
  double weights = 0;
  for (std::size_t i = 0; i < sky_view_factor.size(); ++i) {
    const double weight = seen_weight(sky_view_factor, surface, i);
    if (weight == 0) continue;
    sum += first_bounce[i] / double{surface.normal.values[i].z};
    weights += weight;
  }
  return SeenSkyViewFactor<double>(weights > 0 ? sum / weights : 1);
}

void SeenMoments::add(SkyViewFactor<double> sky_view_factor, SeenSkyViewFactor<double> n) {
  const double a = clamp_share(sky_view_factor.value);
  constexpr double kAlbedo = 0.5;
  const double rest = 1 - kAlbedo * (1 - n.value);
  const double slope = (1 - a) * kAlbedo * (1 - kAlbedo) / (rest * rest);  // ∂G/∂n
  const double w = slope * slope;
  weight += w;
  sky += w * a;
  sky_sky += w * a * a;
  seen += w * n.value;
  seen_sky += w * n.value * a;
}

/// Σ w (n − slope A − t (1 + bend A))² is least at t = Σ w (n − slope A)(1 + bend A)/Σ w (1 + bend A)².
SeenSkyViewFactor<double> tune_deep_seen(const SeenMoments& moments, const SeenConstants& constants) {
  const double slope = constants.deep_slope;
  const double bend = constants.deep_bend;
  const double above =
      moments.seen + bend * moments.seen_sky - slope * (moments.sky + bend * moments.sky_sky);
  const double below = moments.weight + bend * (2 * moments.sky + bend * moments.sky_sky);
  return SeenSkyViewFactor<double>(below > 0 ? clamp_share(above / below) : 1);
}

Map solve_seen(const Map& sky_view_factor, const TexelVector& total) {
  Map n(sky_view_factor.width, sky_view_factor.height);
  parallel_for(n.height, [&](std::int64_t row) {
    const std::size_t begin = n.index(static_cast<int>(row), 0);
    for (std::size_t i = begin; i < begin + static_cast<std::size_t>(n.width); ++i) {
      const SkyViewFactor sky(double{sky_view_factor.values[i]});
      n.values[i] = std::isnan(sky.value)
                        ? std::numeric_limits<float>::quiet_NaN()
                        : static_cast<float>(seen_from_total(sky, total[i], kSeenAlbedo).value);
    }
  });
  return n;
}

Map blur_seen(const Map& sky_view_factor, bool tiles, double sigma) {
  Image<double> weights(sky_view_factor.width, sky_view_factor.height);
  Image<double> weighted = weights;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double sky = clamp_share(double{sky_view_factor.values[i]});
    if (std::isnan(sky)) continue;
    weights.values[i] = 1 - sky;
    weighted.values[i] = (1 - sky) * sky;
  }
  const std::vector<double> kernel = half_kernel(sigma);
  weights = blur(weights, kernel, tiles);
  weighted = blur(weighted, kernel, tiles);
  Map blurred = sky_view_factor;
  for (std::size_t i = 0; i < blurred.size(); ++i) {
    if (std::isnan(blurred.values[i]) || weights.values[i] <= 0) continue;
    blurred.values[i] = static_cast<float>(weighted.values[i] / weights.values[i]);
  }
  return blurred;
}

}  // namespace heightlight
