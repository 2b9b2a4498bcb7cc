#include "solve/reference_sky.h"
#include "solve/solver.h"
#include "transport/horizon_plan.h"
#include "visibility/horizon_sky.h"

namespace heightlight {
namespace {

/// Of the error wanted, that A may have where moments are wanted too: at an RMSE of 0.002 bent normals err by
/// 0.1 to 0.4 degrees, and at most by 0.3 at this share of it (brick walls; other maps by half of that).
constexpr double kMomentShare = 0.6;

/// The plan that there is, or one made now. Sparse azimuths are planned without a maximum distance, and left
/// out with one.
SkyPlan choose_plan(const Task& task, const HeightPyramid& pyramid, const Results& results) {
  const Request& request = task.request;
  if (request.accuracy.plan) return request.accuracy.plan->sky;
  const bool alike = !request.wanted.maximum_distance && request.wanted.below == BelowHorizontal::sky;
  if (results.evidence.plan && alike) return results.evidence.plan->sky;
  SkyCalibration calibration(
      task.surface, pyramid,
      {.seed = request.accuracy.seed, .watch = request.watch, .below = request.wanted.below});
  SkyPlan plan = plan_sky(calibration, plan_goal(request, request.wanted.moments.first));
  if (request.wanted.maximum_distance) {
    plan.full_from = 0;
    plan.full_share = 1;
  }
  return plan;
}

SkyTask task_of(const Wanted& wanted) {
  return {.wanted = wanted.moments, .maximum_distance = wanted.maximum_distance, .below = wanted.below};
}

void take(HorizonSky sky, Results& results) {
  results.ambient_occlusion = std::move(sky.ambient_occlusion);
  results.sky_view_factor = std::move(sky.sky_view_factor);
  results.moments = std::move(sky.moments);
}

void walk_sky_of(const Task& task, Results& results) {
  const Request& request = task.request;
  const Wanted& wanted = request.wanted;
  const HeightPyramid pyramid = build_height_pyramid(task.surface);
  const SkyPlan plan = choose_plan(task, pyramid, results);
  if (!results.evidence.plan) results.evidence.plan.emplace();
  results.evidence.plan->sky = plan;
  if (wants_sky(wanted) && results.sky_view_factor.size() == 0)
    take(walk_horizon_sky(task.surface, pyramid, plan, task_of(wanted), request.watch), results);
  if (wanted.horizon_rad.empty()) return;
  results.horizons = walk_horizons(task.surface, pyramid, plan.walk, wanted.horizon_rad,
                                   wanted.maximum_distance, request.watch);
}

}  // namespace

HorizonGoal plan_goal(const Request& request, bool moments) {
  return {.error = request.accuracy.error,
          .azimuths = request.accuracy.azimuths,
          .seed = request.accuracy.seed,
          .sky_share = moments ? kMomentShare : 1};
}

void find_sky(const Task& task, Results& results) {
  const Accuracy& accuracy = task.request.accuracy;
  const Wanted& wanted = task.request.wanted;
  switch (accuracy.visibility) {
    case Visibility::horizon_walks:
      walk_sky_of(task, results);
      return;
    case Visibility::exact_slices:
      if (results.sky_view_factor.size() == 0) {
        take(slice_sky(task.surface, results.evidence.azimuths, task_of(wanted), task.request.watch),
             results);
      }
      results.horizons =
          slice_horizons(task.surface, wanted.horizon_rad, wanted.maximum_distance, task.request.watch);
      return;
    case Visibility::rays:
      take(cast_sky(task.surface, {.rays = accuracy.rays, .seed = accuracy.seed}, wanted.below,
                    task.request.watch),
           results);
      return;
  }
}

}  // namespace heightlight
