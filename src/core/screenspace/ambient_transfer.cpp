#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/parallel.h"
#include "heightlight/error.h"
#include "heightlight/forms.h"
#include "screenspace/bilateral_gather.h"
#include "screenspace/point_kernel.h"
#include "screenspace/relaxed_points.h"

// From Umenhoffer et al. 2009, section 4.1: a point (ξ_x, ξ_y, ξ_z) of the unit cube becomes the direction
//     ω = T cos(2π ξ_x) √ξ_y + B sin(2π ξ_x) √ξ_y + N √(1 − ξ_y),
// whose density is proportional to the cosine, and the distance r = μ⁻¹(ξ_z): R ξ_z² for the square root, R
// for the step, and −R/4 ln(1 − ξ_z (1 − e⁻⁴)) for the exponential. With I = 1 where the sample is open, O =
// Σ I/n and
//     W = Σ I / (n − Σ (1 − I) a).
// Where the albedo a is the same everywhere, W = O/(1 − a (1 − O)).

namespace heightlight {
namespace {

/// μ⁻¹(xi)/R.
double distance_share(FuzzyMeasure measure, double xi) {
  switch (measure) {
    case FuzzyMeasure::root:
      return xi * xi;
    case FuzzyMeasure::exponential:
      return -std::log1p(xi * std::expm1(-kOpennessRate)) / kOpennessRate;
    case FuzzyMeasure::step:
      break;
  }
  return 1;
}

std::vector<TangentPoint> tangent_points(const AmbientTransferOptions& options) {
  std::vector<TangentPoint> points;
  for (const Eigen::Vector3d& xi : relaxed_points(options.samples)) {
    const double radius = options.radius * distance_share(options.measure, xi.z());
    const double azimuth = 2 * std::numbers::pi * xi.x();
    const double level = radius * std::sqrt(xi.y());
    points.push_back(
        {static_cast<float>(level * std::cos(azimuth)), static_cast<float>(level * std::sin(azimuth)),
         static_cast<float>(radius * std::sqrt(1 - xi.y())), static_cast<float>(1.0 / options.samples)});
  }
  return points;
}

void check_options(const AmbientTransferOptions& options) {
  if (options.samples < 1 || options.samples > 4096) {
    throw UsageError("ambient transfer: samples must be from 1 to 4096");
  }
  if (options.tests < 1 || options.tests > 4096)
    throw UsageError("ambient transfer: tests must be from 1 to 4096");
  if (!(options.radius > 0) || std::isinf(options.radius)) {
    throw UsageError("ambient transfer: the reach must be positive and finite");
  }
}

/// Returns the obscurance, then Σ (1 − I) a / n per varying albedo.
std::vector<Map> trace(const DepthBuffer& depth, const std::vector<const Map*>& varying,
                       const AmbientTransferOptions& options) {
  const std::vector<TangentPoint> points = tangent_points(options);
  const int frames = frame_count(options.noise);
  std::vector<Map> sums(1 + varying.size(), Map(depth.width, depth.height));
  parallel_for(depth.height, [&](std::int64_t i) {
    const int row = static_cast<int>(i);
    const auto width = static_cast<std::size_t>(depth.width);
    PointSums line;
    line.open.resize(width);
    line.albedo.assign(varying.size(), std::vector<float>(width));
    for (int frame = 0; frame < frames; ++frame) {
      PointPass pass{depth, points, options.tests, static_cast<float>(kPointBias * options.radius)};
      set_turns(options.noise, frame, pass);
      pass.albedos = varying;
      test_points(pass, row, line);
    }
    for (std::size_t s = 0; s < sums.size(); ++s) {
      const std::vector<float>& from = s == 0 ? line.open : line.albedo[s - 1];
      for (std::size_t j = 0; j < width; ++j) {
        sums[s](row, static_cast<int>(j)) = from[j] / static_cast<float>(frames);
      }
    }
  });
  return sums;
}

}  // namespace

ScreenSpaceView ambient_transfer(const DepthBuffer& depth, const std::vector<SurfaceAlbedo>& albedos,
                                 const AmbientTransferOptions& options) {
  check_options(options);
  std::vector<const Map*> varying;
  for (const SurfaceAlbedo& albedo : albedos) {
    if (albedo.map) varying.push_back(albedo.map);
  }
  if (varying.size() > kMostAlbedos) throw UsageError("ambient transfer: at most three albedos may vary");
  std::vector<Map> sums = trace(depth, varying, options);
  if (options.noise != DirectionNoise::none) sums = gather_bilaterally(depth, sums);
  ScreenSpaceView view;
  view.samples_per_texel = static_cast<double>(options.samples) * options.tests * frame_count(options.noise);
  view.totals.assign(albedos.size(), Map(depth.width, depth.height));
  for (std::size_t i = 0; i < sums[0].size(); ++i) {
    float& open = sums[0].values[i];
    open = std::isnan(depth.row_height.values[i]) ? std::numeric_limits<float>::quiet_NaN()
                                                  : std::clamp(open, 0.0F, 1.0F);
    std::size_t next = 1;
    for (std::size_t a = 0; a < albedos.size(); ++a) {
      const float reflected =
          albedos[a].map ? sums[next++].values[i] : static_cast<float>(albedos[a].constant) * (1 - open);
      const float rest = 1 - reflected;
      view.totals[a].values[i] = rest > 0 ? std::min(open / rest, 1.0F) : std::isnan(open) ? open : 1.0F;
    }
  }
  view.sky_view_factor = std::move(sums[0]);
  return view;
}

}  // namespace heightlight
