#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/parallel.h"
#include "heightlight/error.h"
#include "screenspace/bilateral_gather.h"
#include "screenspace/point_kernel.h"
#include "screenspace/relaxed_points.h"

// Ritschel et al. 2009, section 3, with all radiances relative to the sky's. Direction i of N stands for Δω =
// 2π/N, so that
//     E/π = Σ L_in(ω_i) V(ω_i) cosθ_i · 2/N.
// cosθ_i takes each of the values (k + ½)/N once, which makes an open receiver's sum exactly 1. A sender of
// radiance L = ρ E₀/π adds L A_s cosθ_s cosθ_r/(π d²).

namespace heightlight {
namespace {

/// How much a blocker at that distance has faded, in [0, 1].
double faded_share(const SsdoOptions& options, double distance) {
  constexpr double kBegin = 0.5;
  if (!options.smooth_end) return 0;
  const double t = std::clamp((distance / options.radius - kBegin) / (1 - kBegin), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Moves the faded part of each point's weight to `kept`, which counts even if the point is hidden.
void fade(const SsdoOptions& options, std::vector<TangentPoint>& points) {
  for (TangentPoint& point : points) {
    const double faded = faded_share(options, std::hypot(point.x, point.y, point.z));
    point.kept = point.weight * static_cast<float>(faded);
    point.weight *= static_cast<float>(1 - faded);
  }
}

std::vector<TangentPoint> tangent_points(const SsdoOptions& options) {
  const std::vector<Eigen::Vector3d>& xis = relaxed_points(options.samples);
  std::vector<std::size_t> order(xis.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(xis[a].y(), a) < std::pair(xis[b].y(), b);
  });
  std::vector<TangentPoint> points(xis.size());
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const Eigen::Vector3d& xi = xis[order[rank]];
    const double cosine = (static_cast<double>(rank) + 0.5) / options.samples;
    const double sine = std::sqrt(1 - cosine * cosine);
    const double azimuth = 2 * std::numbers::pi * xi.x();
    const double distance = options.radius * xi.z();
    points[order[rank]] = {static_cast<float>(distance * sine * std::cos(azimuth)),
                           static_cast<float>(distance * sine * std::sin(azimuth)),
                           static_cast<float>(distance * cosine),
                           static_cast<float>(2 * cosine / options.samples)};
  }
  fade(options, points);
  return points;
}

void check_options(const SsdoOptions& options) {
  if (options.samples < 1 || options.samples > 4096) throw UsageError("ssdo: samples must be from 1 to 4096");
  if (!(options.radius > 0) || std::isinf(options.radius)) {
    throw UsageError("ssdo: the reach must be positive and finite");
  }
}

/// Calls body(row, pass) for each row and frame.
template <class Body>
void for_passes(const DepthBuffer& depth, const std::vector<TangentPoint>& points, const SsdoOptions& options,
                Body&& body) {
  parallel_for(depth.height, [&](std::int64_t row) {
    for (int frame = 0; frame < frame_count(options.noise); ++frame) {
      PointPass pass{depth, points, 1, static_cast<float>(kPointBias * options.radius)};
      set_turns(options.noise, frame, pass);
      body(static_cast<int>(row), pass);
    }
  });
}

void add_row(const std::vector<float>& line, int row, int frames, Map& map) {
  for (std::size_t j = 0; j < line.size(); ++j) {
    map(row, static_cast<int>(j)) += line[j] / static_cast<float>(frames);
  }
}

std::vector<Map> filter(const DepthBuffer& depth, const SsdoOptions& options, std::vector<Map> maps) {
  if (options.noise != DirectionNoise::none) maps = gather_bilaterally(depth, maps);
  for (Map& map : maps) {
    for (std::size_t i = 0; i < map.size(); ++i) {
      if (std::isnan(depth.row_height.values[i])) map.values[i] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return maps;
}

/// E₀/π under an even sky.
Map trace_direct(const DepthBuffer& depth, const std::vector<TangentPoint>& points,
                 const SsdoOptions& options) {
  double kept = 0;
  for (const TangentPoint& point : points) kept += double{point.kept};
  std::vector<Map> sums(1, Map(depth.width, depth.height, static_cast<float>(kept)));
  for_passes(depth, points, options, [&](int row, const PointPass& pass) {
    PointSums line;
    line.open.resize(static_cast<std::size_t>(depth.width));
    test_points(pass, row, line);
    add_row(line.open, row, frame_count(options.noise), sums[0]);
  });
  return std::move(filter(depth, options, std::move(sums))[0]);
}

/// E₁/π from senders of the given radiance.
Map trace_bounce(const DepthBuffer& depth, const std::vector<TangentPoint>& points,
                 const SsdoOptions& options, const Map& sender) {
  std::vector<Map> sums(1, Map(depth.width, depth.height));
  const auto area = static_cast<float>(options.radius * options.radius / options.samples);  // A_s/π
  const auto texel = static_cast<float>(std::sqrt(depth.spacing.x * depth.spacing.y));
  for_passes(depth, points, options, [&](int row, const PointPass& pass) {
    std::vector<float> line(static_cast<std::size_t>(depth.width));
    bounce_points({pass, sender, area, texel}, row, line);
    add_row(line, row, frame_count(options.noise), sums[0]);
  });
  return std::move(filter(depth, options, std::move(sums))[0]);
}

}  // namespace

ScreenSpaceView ssdo(const DepthBuffer& depth, const std::vector<SurfaceAlbedo>& albedos,
                     const SsdoOptions& options) {
  check_options(options);
  const std::vector<TangentPoint> points = tangent_points(options);
  ScreenSpaceView view;
  view.samples_per_texel = static_cast<double>(options.samples) * frame_count(options.noise);
  view.sky_view_factor = trace_direct(depth, points, options);
  Map white;  // the bounce of a white surface; constant albedos scale it
  for (const SurfaceAlbedo& albedo : albedos) {
    Map total = view.sky_view_factor;
    if (albedo.map) {
      Map sender = view.sky_view_factor;
      for (std::size_t i = 0; i < sender.size(); ++i) sender.values[i] *= albedo.map->values[i];
      const Map bounce = trace_bounce(depth, points, options, sender);
      for (std::size_t i = 0; i < total.size(); ++i) total.values[i] += bounce.values[i];
    } else {
      if (white.size() == 0) white = trace_bounce(depth, points, options, view.sky_view_factor);
      const auto share = static_cast<float>(albedo.constant);
      for (std::size_t i = 0; i < total.size(); ++i) total.values[i] += share * white.values[i];
    }
    view.totals.push_back(std::move(total));
  }
  return view;
}

double ssdo_solid_angle(const SsdoOptions& options) { return 2 * std::numbers::pi / options.samples; }

Image<Vector3> ssdo_under_sky(const DepthBuffer& depth, const SkyGrid& sky, const SsdoOptions& options) {
  check_options(options);
  const std::vector<TangentPoint> points = tangent_points(options);
  std::vector<Map> sums(3, Map(depth.width, depth.height));
  for_passes(depth, points, options, [&](int row, PointPass pass) {
    pass.sky = &sky;
    PointSums line;
    line.open.resize(static_cast<std::size_t>(depth.width));
    for (std::vector<float>& channel : line.sky) channel.resize(line.open.size());
    test_points(pass, row, line);
    for (std::size_t c = 0; c < sums.size(); ++c)
      add_row(line.sky[c], row, frame_count(options.noise), sums[c]);
  });
  sums = filter(depth, options, std::move(sums));
  Image<Vector3> light(depth.width, depth.height);
  for (std::size_t i = 0; i < light.size(); ++i)
    light.values[i] = {sums[0].values[i], sums[1].values[i], sums[2].values[i]};
  return light;
}

}  // namespace heightlight
