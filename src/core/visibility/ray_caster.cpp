#include "visibility/ray_caster.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/texel_algebra.h"
#include "heightlight/error.h"
#include "heightlight/occlusion_forms.h"
#include "visibility/slope_bounds.h"

namespace heightlight {
namespace {

constexpr int kMostRays = 65536;
constexpr float kSteepest = 1e30F;  // finite, so that 0 · slope stays 0

HemisphereDirections make_directions(const RayOptions& options) {
  check_ray_options(options);
  return make_hemisphere_directions(options.rays, options.seed);
}

std::size_t padded(int rays) { return static_cast<std::size_t>(rays + kRayPadding); }

/// Turns directions from world axes to those of grid rays.
struct GridTurn {
  float per_x, per_y;

  explicit GridTurn(const Spacing& spacing)
      : per_x(static_cast<float>(1 / spacing.x)),
        per_y(static_cast<float>(-1 / spacing.y)) {}  // rows run down, y up

  void set_ray(std::size_t k, const Eigen::Vector3f& direction, RayWorkspace& workspace) const {
    const float u = direction.x() * per_x;
    const float v = direction.y() * per_y;
    const float texels = std::sqrt(u * u + v * v);
    const float per_texel = 1.0F / std::max(texels, 1e-30F);
    workspace.step_u[k] = u * per_texel;
    workspace.step_v[k] = v * per_texel;
    workspace.slope[k] = std::clamp(direction.z() * per_texel, -kSteepest, kSteepest);
  }
};

/// Finds from which way on each ray has nothing in its path: by the bounds of its quadrant, or because it is
/// above the map's highest point, which is `above` higher than the receiver.
void find_sky_ways(const SlopeBounds& bounds, float above, int count, RayWorkspace& workspace) {
  const float* step_u = workspace.step_u.data();
  const float* step_v = workspace.step_v.data();
  const float* slope = workspace.slope.data();
  float* sky_way = workspace.sky_way.data();
  for (int k = 0; k < count; ++k) {
    sky_way[k] = slope[k] > 0 ? above / slope[k] : std::numeric_limits<float>::infinity();
  }
  for (auto level = static_cast<std::size_t>(bounds.levels); level-- > 0;) {
    const float way = bounds.way[level];
    const std::array<float, 4> bound{bounds.slope[0][level], bounds.slope[1][level], bounds.slope[2][level],
                                     bounds.slope[3][level]};
    for (int k = 0; k < count; ++k) {  // only selections, so that the compiler vectorises the loop
      const float falling_rows = step_u[k] > 0 ? bound[1] : bound[0];
      const float rising_rows = step_u[k] > 0 ? bound[3] : bound[2];
      const float steepest = step_v[k] > 0 ? rising_rows : falling_rows;
      const float nearer = way < sky_way[k] ? way : sky_way[k];
      sky_way[k] = slope[k] >= steepest ? nearer : sky_way[k];
    }
  }
}

}  // namespace

void check_ray_options(const RayOptions& options) {
  if (options.rays >= 1 && options.rays <= kMostRays) return;
  throw UsageError("rays", std::to_string(options.rays), "must be from 1 to " + std::to_string(kMostRays));
}

RayWorkspace::RayWorkspace(int rays)
    : step_u(padded(rays)),
      step_v(padded(rays)),
      slope(padded(rays)),
      sky_way(padded(rays)),
      cell(padded(rays)),
      across(padded(rays)),
      down(padded(rays)) {}

RayCaster::RayCaster(const Surface& surface, const RayOptions& options)
    : surface_(surface), directions_(make_directions(options)) {
  if (surface.cell_columns() > 0 && surface.cell_rows() > 0) pyramid_ = build_maximum_pyramid(surface);
  grid_ = make_ray_grid(surface, pyramid_);
}

RayBundle RayCaster::aim_directions(int row, int column, const LatticeTurn& turn,
                                    RayWorkspace& workspace) const {
  const Vector3& normal = surface_.normal(row, column);
  const NormalFrame<float> frame({normal.x, normal.y, normal.z});
  const auto table = static_cast<std::size_t>(turn.table);
  const float* cosine = directions_.cosine[table].data();
  const float* sine = directions_.sine[table].data();
  const float* azimuth_cosine = directions_.azimuth_cosine.data();
  const float* azimuth_sine = directions_.azimuth_sine.data();
  const GridTurn turn_to_grid(surface_.map.spacing);
  for (int k = 0; k < directions_.count; ++k) {
    const float along_tangent = sine[k] * (azimuth_cosine[k] * turn.cosine - azimuth_sine[k] * turn.sine);
    const float along_bitangent = sine[k] * (azimuth_sine[k] * turn.cosine + azimuth_cosine[k] * turn.sine);
    const float x =
        along_tangent * frame.tangent.x + along_bitangent * frame.bitangent.x + cosine[k] * frame.normal.x;
    const float y =
        along_tangent * frame.tangent.y + along_bitangent * frame.bitangent.y + cosine[k] * frame.normal.y;
    const float z =
        along_tangent * frame.tangent.z + along_bitangent * frame.bitangent.z + cosine[k] * frame.normal.z;
    turn_to_grid.set_ray(static_cast<std::size_t>(k), {x, y, z}, workspace);
  }
  return bundle_of(row, column, directions_.count, workspace);
}

RayBundle RayCaster::bundle_of(int row, int column, int count, const RayWorkspace& workspace) const {
  RayBundle bundle;
  bundle.column = column;
  bundle.row = row;
  bundle.height = surface_.map.height(row, column);
  bundle.count = count;
  bundle.step_u = workspace.step_u.data();
  bundle.step_v = workspace.step_v.data();
  bundle.slope = workspace.slope.data();
  return bundle;
}

void RayCaster::find_sky_ways_of(RayBundle& bundle, RayWorkspace& workspace) const {
  const SlopeBounds bounds = bound_slopes(grid_, bundle.row, bundle.column, bundle.height);
  find_sky_ways(bounds, grid_.highest - bundle.height, bundle.count, workspace);
  bundle.sky_way = workspace.sky_way.data();
}

RayBundle RayCaster::aim(int row, int column, const LatticeTurn& turn, RayWorkspace& workspace) const {
  RayBundle bundle = aim_directions(row, column, turn, workspace);
  find_sky_ways_of(bundle, workspace);
  return bundle;
}

void RayCaster::look_along(int row, int column, const std::vector<Eigen::Vector3f>& directions,
                           RayWorkspace& workspace, std::vector<char>& open) const {
  assert(directions.size() <= static_cast<std::size_t>(directions_.count));
  open.assign(directions.size(), 1);
  if (pyramid_.levels == 0) return;  // no cells: nothing occludes
  const GridTurn turn_to_grid(surface_.map.spacing);
  for (std::size_t k = 0; k < directions.size(); ++k) turn_to_grid.set_ray(k, directions[k], workspace);
  RayBundle bundle = bundle_of(row, column, static_cast<int>(directions.size()), workspace);
  find_sky_ways_of(bundle, workspace);
  traverse(grid_, bundle, {workspace.cell.data(), workspace.across.data(), workspace.down.data()});
  for (std::size_t k = 0; k < directions.size(); ++k) open[k] = workspace.cell[k] == kSky ? 1 : 0;
}

void RayCaster::view(int row, int column, RayWorkspace& workspace, ReceiverView& view) const {
  view.rays = 0;
  view.ray.clear();
  view.place.clear();
  if (std::isnan(surface_.map.height(row, column))) return;
  const LatticeTurn turn = directions_.turn(row, column);
  view.rays = directions_.count;
  view.weight_table = static_cast<std::uint8_t>(turn.table);
  view.weight = directions_.weight[static_cast<std::size_t>(turn.table)].data();
  if (pyramid_.levels == 0) return;  // no cells: nothing occludes
  const RayBundle bundle = aim(row, column, turn, workspace);
  traverse(grid_, bundle, {workspace.cell.data(), workspace.across.data(), workspace.down.data()});
  for (int k = 0; k < bundle.count; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (workspace.cell[i] == kSky) continue;
    view.ray.push_back(static_cast<std::uint16_t>(k));
    view.place.push_back(
        {static_cast<std::uint32_t>(workspace.cell[i]), workspace.across[i], workspace.down[i]});
  }
}

SkyShare RayCaster::share_above_horizontal(int row, int column, const ReceiverView& view,
                                           RayWorkspace& workspace) const {
  aim_directions(row, column, directions_.turn(row, column), workspace);
  const Gradient level = level_gradient(surface_.map, row, column);
  const auto level_x = static_cast<float>(level.x * surface_.map.spacing.x);
  const auto level_y = static_cast<float>(-level.y * surface_.map.spacing.y);  // rows run down, y up
  SkyShare share = sky_share(view);
  auto hit = view.ray.begin();
  for (int k = 0; k < view.rays; ++k) {
    if (hit != view.ray.end() && *hit == k) {
      ++hit;
      continue;
    }
    const auto i = static_cast<std::size_t>(k);
    if (workspace.slope[i] >= level_x * workspace.step_u[i] + level_y * workspace.step_v[i]) continue;
    share.ambient_occlusion -= 1.0 / view.rays;
    share.sky_view_factor -= view.weight[k];
  }
  return {std::max(0.0, share.ambient_occlusion), std::max(0.0, share.sky_view_factor)};
}

SkyShare sky_share(const ReceiverView& view) {
  double seen = 0;
  for (const std::uint16_t ray : view.ray) seen += view.weight[ray];
  const double hits = static_cast<double>(view.ray.size());
  return {1 - hits / view.rays, std::max(0.0, 1 - seen)};
}

}  // namespace heightlight
