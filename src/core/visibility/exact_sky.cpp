#include "visibility/exact_sky.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/gauss_legendre.h"
#include "base/texel_algebra.h"
#include "heightlight/forms.h"
#include "visibility/slice_integrals.h"

namespace heightlight {
namespace {

/// Adds the integrals over a slice: its mass, its solid angle, and its first and second moments along d and
/// z.
void add_slice(const Eigen::Vector2d& azimuth, double mass, double angle, const Eigen::Vector2d& first,
               const Eigen::Vector2d& second, ExactSky& open) {
  const double x = azimuth.x();
  const double y = azimuth.y();
  open.sky_view_factor += mass;
  open.ambient_occlusion += angle;
  open.first += Eigen::Vector3d(first.x() * x, first.x() * y, first.y());
  open.second[0] += second.x() * (x * x - y * y);
  open.second[1] += second.x() * x * y;
  open.second[2] += mass - second.x();
  open.second[3] += second.y() * x;
  open.second[4] += second.y() * y;
}

/// Adds a straight part of the profile that is seen from `from_slope` to its own slope. Angles are integrated
/// by Gauss's rule in pieces of 0.1 rad, or of 0.001 rad where the part crosses the sphere of the maximum
/// distance. The line's distance under each angle follows from the two ends.
void add_stretch(const SliceNormal& normal, const Eigen::Vector2d& azimuth, double from_slope,
                 const VisibleStretch& stretch, const MaximumDistance& maximum_distance, ExactSky& open) {
  static const std::vector<QuadratureNode> kNodes = gauss_legendre(4);
  const double from = std::atan(from_slope);
  const double to = std::atan(stretch.slope);
  const double rise = stretch.slope * stretch.end_way - from_slope * stretch.begin_way;
  const double run = stretch.end_way - stretch.begin_way;
  const bool is_nearer = stretch.begin_way / std::cos(from) < maximum_distance.distance;
  const bool crosses = is_nearer != (stretch.end_way / std::cos(to) < maximum_distance.distance);
  const int pieces = std::max(1, static_cast<int>(std::ceil((to - from) / (crosses ? 1e-3 : 0.1))));
  for (int piece = 0; piece < pieces; ++piece) {
    for (const QuadratureNode& node : kNodes) {
      const double elevation = from + (piece + node.at) / pieces * (to - from);
      const double slope = std::tan(elevation);
      // (begin + t run) slope = begin from_slope + t rise
      const double denominator = slope * run - rise;
      const double t = denominator != 0 ? stretch.begin_way * (from_slope - slope) / denominator : 0.5;
      const double way = stretch.begin_way + std::clamp(t, 0.0, 1.0) * run;
      const double cosine = std::cos(elevation);
      const double sine = std::sin(elevation);
      const double share = open_share(maximum_distance, way / cosine) * node.weight * (to - from) / pieces;
      const double mass = share * (normal.along * cosine + normal.up * sine) * cosine;
      add_slice(azimuth, mass, share * cosine, mass * Eigen::Vector2d(cosine, sine),
                mass * Eigen::Vector2d(cosine * cosine, cosine * sine), open);
    }
  }
}

/// Is the stretch the receiver's own facet, where it rises above the tangent plane? Such a facet is seen at
/// its middle, through which no edge of a cell goes.
bool is_own_facet(const VisibleStretch& stretch) {
  const float across = stretch.begin.across;
  const float down = stretch.begin.down;
  return stretch.begin_way == stretch.end_way && across != down && std::min(across, down) > 0 &&
         std::max(across, down) < 1;
}

}  // namespace

double open_share(const MaximumDistance& maximum_distance, double distance) {
  const double share = distance / maximum_distance.distance;
  if (share >= 1) return 1;
  switch (maximum_distance.falloff) {
    case Falloff::none:
      return 0;
    case Falloff::linear:
      return share;
    case Falloff::root:
      return std::sqrt(share);
    case Falloff::exponential:
      return exponential_openness(share, 1.0);
  }
  return 0;
}

double sky_above_horizontal(const ExactWalker& walker, int row, int column, const SliceView& view) {
  const Eigen::Vector3d normal = as_eigen(walker.normal(row, column)).cast<double>().normalized();
  SkyShareSum sky;
  for (int k = 0; k < walker.azimuths(); ++k) {
    const Eigen::Vector2d azimuth(std::cos(walker.azimuth_rad(k)), std::sin(walker.azimuth_rad(k)));
    const double horizon = std::tan(view.horizon_rad[static_cast<std::size_t>(k)]);
    sky.add({normal.head<2>().dot(azimuth), normal.z()},
            std::max(walker.level_slope(row, column, azimuth), horizon));
  }
  return sky.value();
}

ExactSky find_exact_sky(const ExactWalker& walker, int row, int column,
                        const std::optional<MaximumDistance>& maximum_distance, BelowHorizontal below) {
  ExactSky sky;
  if (std::isnan(walker.height(row, column))) {
    constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
    sky.ambient_occlusion = sky.sky_view_factor = kMissing;
    sky.first.setConstant(kMissing);
    sky.second.fill(kMissing);
    return sky;
  }
  sky.ambient_occlusion = sky.sky_view_factor = 0;
  const Eigen::Vector3d normal = as_eigen(walker.normal(row, column)).cast<double>().normalized();
  double mass = 0;
  double angle = 0;
  std::vector<VisibleStretch> stretches;
  for (int k = 0; k < walker.azimuths(); ++k) {
    const Eigen::Vector2d azimuth(std::cos(walker.azimuth_rad(k)), std::sin(walker.azimuth_rad(k)));
    const SliceNormal in_slice{normal.head<2>().dot(azimuth), normal.z()};
    const double tangent = tangent_slope(in_slice);
    const double lowest = below == BelowHorizontal::ground
                              ? std::max(tangent, walker.level_slope(row, column, azimuth))
                              : tangent;
    stretches.clear();
    const double horizon = walker.walk(row, column, azimuth, lowest, stretches);
    const Elevation plane = elevation_of_slope(tangent);
    const Elevation above = elevation_of_slope(std::max(lowest, horizon));
    mass += cosine_mass(in_slice, plane, {});
    angle += solid_angle_above(plane);
    add_slice(azimuth, cosine_mass(in_slice, above, {}), solid_angle_above(above),
              bent_mass_above(in_slice, above), second_mass_above(in_slice, above), sky);
    if (!maximum_distance) continue;
    double from = lowest;
    for (const VisibleStretch& stretch : stretches) {
      if (!is_own_facet(stretch)) add_stretch(in_slice, azimuth, from, stretch, *maximum_distance, sky);
      from = stretch.slope;
    }
  }
  sky.ambient_occlusion /= angle;
  sky.sky_view_factor /= mass;
  sky.first /= mass;
  for (double& value : sky.second) value /= mass;
  return sky;
}

}  // namespace heightlight
