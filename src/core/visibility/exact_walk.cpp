#include "visibility/exact_walk.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/texel_algebra.h"
#include "visibility/slice_integrals.h"

namespace heightlight {
namespace {

constexpr double kNothingKnown = std::numeric_limits<double>::quiet_NaN();

/// Horizontal unit vector of an azimuth. The vector of an azimuth along an axis misses the axis by the
/// rounding of π. On the outer line of an open map it would leave the map at once.
Eigen::Vector2d unit_azimuth(double azimuth_rad) {
  const auto snapped = [](double component) { return std::fabs(component) < 1e-15 ? 0.0 : component; };
  return {snapped(std::cos(azimuth_rad)), snapped(std::sin(azimuth_rad))};
}

/// The place between two places in one cell, at a share of the line from the first to the second.
SurfacePoint place_between(const SurfacePoint& begin, const SurfacePoint& end, double share) {
  const auto part = static_cast<float>(share);
  return {begin.cell, begin.across + part * (end.across - begin.across),
          begin.down + part * (end.down - begin.down)};
}

}  // namespace

std::uint64_t slice_view_bytes(int width, int height, int azimuths) {
  const double stretches = 2 * std::sqrt(std::max(width, height));
  return static_cast<std::uint64_t>(azimuths * (stretches * sizeof(VisibleInterval) + sizeof(double)));
}

ExactWalker::ExactWalker(const Surface& surface, int azimuths, double maximum_distance)
    : surface_(surface), azimuths_(azimuths), maximum_distance_(maximum_distance) {
  assert(azimuths >= 1 && maximum_distance > 0);
  if (surface.cell_columns() > 0 && surface.cell_rows() > 0) pyramid_ = build_maximum_pyramid(surface);
  grid_ = make_ray_grid(surface, pyramid_);
}

ExactWalker::ExactWalker(const Surface& header, int azimuths, const StoredGround& ground,
                         MaximumPyramid bounds, int first_level)
    : surface_(header),
      ground_(&ground),
      pyramid_(std::move(bounds)),
      azimuths_(azimuths),
      maximum_distance_(std::numeric_limits<double>::infinity()) {
  grid_ = make_ray_grid(header, pyramid_);
  grid_.ground = &ground;
  grid_.first_level = first_level;
}

double ExactWalker::azimuth_rad(int k) const { return 2 * std::numbers::pi * (k + 0.25) / azimuths_; }

double ExactWalker::walk(int row, int column, const Eigen::Vector2d& azimuth, double least_slope,
                         std::vector<VisibleStretch>& stretches) const {
  if (pyramid_.levels == 0) return -std::numeric_limits<double>::infinity();  // no cells: nothing occludes
  ProfileLine line;
  line.row = row;
  line.column = column;
  line.height = double{height(row, column)};
  line.step_u = azimuth.x() / surface_.map.spacing.x;
  line.step_v = -azimuth.y() / surface_.map.spacing.y;  // rows run down, y up
  line.maximum_distance = maximum_distance_;
  return walk_profile(grid_, line, least_slope, stretches);
}

double ExactWalker::horizon_slope(int row, int column, const Eigen::Vector2d& azimuth) const {
  std::vector<VisibleStretch> unused;
  return walk(row, column, azimuth, std::numeric_limits<double>::infinity(), unused);
}

double ExactWalker::level_slope(int row, int column, const Eigen::Vector2d& azimuth) const {
  const Gradient level = level_gradient(surface_.map, row, column);
  return level.x * azimuth.x() + level.y * azimuth.y();
}

double ExactWalker::horizon_rad(int row, int column, double azimuth_rad) const {
  if (std::isnan(height(row, column))) return kNothingKnown;
  return std::atan(horizon_slope(row, column, unit_azimuth(azimuth_rad)));
}

void ExactWalker::view(int row, int column, SliceView& view) const {
  view.horizon_rad.clear();
  view.links.clear();
  view.links_end.clear();
  if (std::isnan(height(row, column))) {
    view.ambient_occlusion = view.sky_view_factor = kNothingKnown;
    view.bent_normal.setConstant(kNothingKnown);
    return;
  }
  const Eigen::Vector3d n = as_eigen(normal(row, column)).cast<double>().normalized();
  double hemisphere_mass = 0;
  double hemisphere_angle = 0;
  double sky_mass = 0;
  double sky_angle = 0;
  Eigen::Vector3d bent = Eigen::Vector3d::Zero();
  std::vector<VisibleStretch> stretches;
  for (int k = 0; k < azimuths_; ++k) {
    const Eigen::Vector2d azimuth = unit_azimuth(azimuth_rad(k));
    const SliceNormal in_slice{n.head<2>().dot(azimuth), n.z()};
    const double tangent = tangent_slope(in_slice);
    stretches.clear();
    const double horizon = walk(row, column, azimuth, tangent, stretches);
    view.horizon_rad.push_back(std::atan(horizon));

    const Elevation zenith;
    const Elevation lowest = elevation_of_slope(tangent);
    const Elevation sky = elevation_of_slope(std::max(tangent, horizon));
    hemisphere_mass += cosine_mass(in_slice, lowest, zenith);
    hemisphere_angle += solid_angle_above(lowest);
    sky_mass += cosine_mass(in_slice, sky, zenith);
    sky_angle += solid_angle_above(sky);
    const Eigen::Vector2d slice_bent = bent_mass_above(in_slice, sky);
    bent.head<2>() += slice_bent.x() * azimuth;
    bent.z() += slice_bent.y();
    Elevation from = lowest;
    for (const VisibleStretch& stretch : stretches) {
      const Elevation to = elevation_of_slope(stretch.slope);
      const double share = mean_share(in_slice, from, to, stretch.begin_way, stretch.end_way);
      view.links.push_back(
          {cosine_mass(in_slice, from, to), place_between(stretch.begin, stretch.end, share)});
      from = to;
    }
    view.links_end.push_back(view.links.size());
  }
  for (VisibleInterval& link : view.links) link.weight /= hemisphere_mass;
  view.ambient_occlusion = sky_angle / hemisphere_angle;
  view.sky_view_factor = sky_mass / hemisphere_mass;
  view.bent_normal = bent.normalized();
}

}  // namespace heightlight
