#include "solve/reference_sky.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/texel_algebra.h"
#include "visibility/exact_sky.h"
#include "visibility/ray_caster.h"

namespace heightlight {
namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

/// Calls visit(row, progress) for all rows on all threads, as one step. A row of exact walks takes long:
/// visits ask at each texel whether to go on.
template <class Visit>
void for_rows(const Surface& surface, const char* step, const Watch& watch, Visit&& visit) {
  Progress progress(step, surface.height(), watch);
  parallel_for(
      surface.height(), [&](std::int64_t row) { visit(static_cast<int>(row), progress); }, &progress);
}

HorizonSky empty_sky(const Surface& surface, const SkyWanted& wanted) {
  const int width = surface.width();
  const int height = surface.height();
  HorizonSky sky{Map(width, height, kMissing), Map(width, height, kMissing), {}};
  if (wanted.first) sky.moments.first = Image<Vector3>(width, height);
  if (wanted.second) sky.moments.second = Image<std::array<float, 5>>(width, height);
  return sky;
}

}  // namespace

HorizonSky slice_sky(const Surface& surface, int azimuths, const SkyTask& task, const Watch& watch) {
  const ExactWalker walker(surface, azimuths);
  HorizonSky sky = empty_sky(surface, task.wanted);
  for_rows(surface, "sky", watch, [&](int row, const Progress& progress) {
    for (int column = 0; column < surface.width(); ++column) {
      progress.throw_if_stopped();
      const ExactSky exact = find_exact_sky(walker, row, column, task.maximum_distance, task.below);
      sky.ambient_occlusion(row, column) = static_cast<float>(exact.ambient_occlusion);
      sky.sky_view_factor(row, column) = static_cast<float>(exact.sky_view_factor);
      if (task.wanted.first) sky.moments.first(row, column) = to_vector3(exact.first.cast<float>());
      if (!task.wanted.second) continue;
      std::transform(exact.second.begin(), exact.second.end(), sky.moments.second(row, column).begin(),
                     [](double value) { return static_cast<float>(value); });
    }
  });
  return sky;
}

std::vector<Map> slice_horizons(const Surface& surface, const std::vector<double>& azimuths_rad,
                                const std::optional<MaximumDistance>& maximum_distance, const Watch& watch) {
  std::vector<Map> horizons(azimuths_rad.size(), Map(surface.width(), surface.height(), kMissing));
  if (horizons.empty()) return horizons;
  const ExactWalker walker(surface, 1, exact_maximum_distance(maximum_distance));
  for_rows(surface, "horizons", watch, [&](int row, const Progress& progress) {
    for (int column = 0; column < surface.width(); ++column) {
      progress.throw_if_stopped();
      const Vector3& normal = surface.normal(row, column);
      for (std::size_t k = 0; k < azimuths_rad.size(); ++k) {
        const double azimuth = azimuths_rad[k];
        const double along = double{normal.x} * std::cos(azimuth) + double{normal.y} * std::sin(azimuth);
        const double tangent = -along / double{normal.z};
        const double horizon = std::tan(walker.horizon_rad(row, column, azimuth));
        if (std::isnan(horizon)) continue;
        const double level = walker.level_slope(row, column, {std::cos(azimuth), std::sin(azimuth)});
        horizons[k](row, column) = static_cast<float>(std::atan(std::max(horizon, tangent) - level));
      }
    }
  });
  return horizons;
}

std::vector<Map> slice_horizon_means(const Surface& surface, int azimuths,
                                     const std::vector<HorizonMean>& means,
                                     const std::optional<MaximumDistance>& maximum_distance,
                                     const Watch& watch) {
  std::vector<Map> found(means.size(), Map(surface.width(), surface.height(), kMissing));
  const ExactWalker walker(surface, azimuths, exact_maximum_distance(maximum_distance));
  for_rows(surface, "horizons", watch, [&](int row, const Progress& progress) {
    for (int column = 0; column < surface.width(); ++column) {
      progress.throw_if_stopped();
      if (std::isnan(surface.map.height(row, column))) continue;
      const HorizonTerms<double> exact = exact_horizon_means(walker, row, column);
      for (std::size_t k = 0; k < means.size(); ++k)
        found[k](row, column) = static_cast<float>(exact[static_cast<std::size_t>(means[k])]);
    }
  });
  return found;
}

HorizonSky cast_sky(const Surface& surface, const RayOptions& rays, BelowHorizontal below,
                    const Watch& watch) {
  const RayCaster caster(surface, rays);
  HorizonSky sky = empty_sky(surface, {});
  for_rows(surface, "sky", watch, [&](int row, const Progress& progress) {
    RayWorkspace workspace(rays.rays);
    ReceiverView view;
    for (int column = 0; column < surface.width(); ++column) {
      progress.throw_if_stopped();
      caster.view(row, column, workspace, view);
      if (view.rays == 0) continue;
      const SkyShare share = below == BelowHorizontal::ground
                                 ? caster.share_above_horizontal(row, column, view, workspace)
                                 : sky_share(view);
      sky.sky_view_factor(row, column) = static_cast<float>(share.sky_view_factor);
      sky.ambient_occlusion(row, column) = static_cast<float>(share.ambient_occlusion);
    }
  });
  return sky;
}

}  // namespace heightlight
