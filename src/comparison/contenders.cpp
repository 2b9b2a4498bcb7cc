#include "comparison/contenders.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "core/parallel.h"
#include "transport/horizon_pilot.h"
#include "transport/horizon_plan.h"
#include "visibility/height_mips.h"
#include "visibility/horizon_sky.h"
#include "visibility/ray_caster.h"

namespace heightlight {
namespace {

Estimate trace_rays(const ComparedScene& scene, int count) {
  const Surface& surface = scene.surface;
  const RayCaster caster(surface, {count, scene.seed});
  Estimate estimate;
  estimate.sky_view_factor = estimate.ambient_occlusion = Map(surface.width(), surface.height());
  parallel_for(surface.height(), [&](std::int64_t i) {
    const int row = static_cast<int>(i);
    RayWorkspace workspace(count);
    ReceiverView view;
    for (int column = 0; column < surface.width(); ++column) {
      caster.view(row, column, workspace, view);
      const double missing = std::numeric_limits<double>::quiet_NaN();
      const SkyShare share = view.rays > 0 ? sky_share(view) : SkyShare{missing, missing};
      estimate.sky_view_factor(row, column) = static_cast<float>(share.sky_view_factor);
      estimate.ambient_occlusion(row, column) = static_cast<float>(share.ambient_occlusion);
    }
  });
  estimate.samples_per_texel = count;
  return estimate;
}

/// The totals, and nothing else: what finding A alone costs is another contender's.
Estimate solve_totals_of(const ComparedScene& scene, const Transport& transport) {
  constexpr double kTolerance = 1e-4;
  Estimate estimate;
  for (const ComparedAlbedo& albedo : scene.albedos) {
    const TexelVector total =
        albedo.constant()
            ? solve_totals(transport, {albedo.reflectance[0]}, kTolerance).totals[0]
            : solve_equilibrium(transport, transport.direct, albedo.reflectance, transport.direct).irradiance;
    estimate.totals.push_back(to_map(total, scene.surface));
  }
  return estimate;
}

Estimate link_rays(const ComparedScene& scene, int count) {
  FormFactorOptions options;
  options.rays = {count, scene.seed};
  options.memory_limit = scene.memory_limit;
  Estimate estimate = solve_totals_of(scene, build_form_factors(scene.surface, options));
  estimate.samples_per_texel = count;
  return estimate;
}

Estimate walk_sky(const ComparedScene& scene, const WalkOptions& options) {
  HorizonSky sky = walk_horizon_sky(scene.surface, build_height_mips(scene.surface), options, true);
  Estimate estimate;
  estimate.sky_view_factor = std::move(sky.sky_view_factor);
  estimate.ambient_occlusion = std::move(sky.ambient_occlusion);
  return estimate;
}

Estimate plan_and_walk_sky(const ComparedScene& scene, double error) {
  HorizonGoal goal;
  goal.error = error;
  goal.seed = scene.seed;
  HorizonPilot pilot(scene.surface, scene.seed);
  return walk_sky(scene, plan_sky(pilot, goal).sky);
}

Estimate plan_totals(const ComparedScene& scene, double error) {
  HorizonGoal goal;
  goal.error = error;
  goal.total_only = true;
  goal.seed = scene.seed;
  const PlannedTransport planned = plan_horizon_transport(scene.surface, goal, {scene.memory_limit, true});
  return solve_totals_of(scene, *planned.transport);
}

Estimate run_screen_space(const ComparedScene& scene, const ScreenSpaceMethod& method) {
  std::vector<SurfaceAlbedo> albedos;
  for (const ComparedAlbedo& albedo : scene.albedos)
    albedos.push_back({albedo.reflectance[0], albedo.constant() ? nullptr : &albedo.varying});
  ScreenSpaceView view = method.run(scene.depth, albedos);
  Estimate estimate;
  estimate.sky_view_factor = std::move(view.sky_view_factor);
  estimate.ambient_occlusion = std::move(view.ambient_occlusion);
  estimate.bent_normal = std::move(view.bent_normal);
  estimate.half_sky = std::move(view.half_sky);
  estimate.seen = std::move(view.seen);
  estimate.totals = std::move(view.totals);
  estimate.samples_per_texel = view.samples_per_texel;
  return estimate;
}

std::string in_words(const char* format, double number) {
  char text[64];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

void add_rays(const ComparedScene& scene, std::vector<Contender>& contenders) {
  for (const int count : {4, 16, 64, 256}) {
    contenders.push_back({"rays", in_words("%g rays", count), count == 64,
                          [scene, count] { return trace_rays(scene, count); }});
  }
  for (const int count : {16, 64, 256}) {
    contenders.push_back({"rays with links", in_words("%g rays", count), false,
                          [scene, count] { return link_rays(scene, count); }});
  }
}

void add_walks(const ComparedScene& scene, std::vector<Contender>& contenders) {
  for (const WalkOptions options :
       {WalkOptions{4, 8, 0.3F}, WalkOptions{8, 8, 0.3F}, WalkOptions{16, 8, 0.3F}, WalkOptions{16, 16, 0.3F},
        WalkOptions{32, 16, 0.3F}, WalkOptions{64, 32, 0.3F}}) {
    contenders.push_back(
        {"horizon walk",
         in_words("%g azimuths", options.azimuths) + in_words("; fineness %g", options.fineness),
         options.azimuths == 8, [scene, options] { return walk_sky(scene, options); }});
  }
  for (const double error : {0.01, 0.005, 0.002, 0.001}) {
    contenders.push_back({"horizon walk planned", in_words("error %g", error), false,
                          [scene, error] { return plan_and_walk_sky(scene, error); }});
  }
  for (const double error : {0.02, 0.01, 0.005, 0.002}) {
    contenders.push_back({"horizon walk with links", in_words("error %g", error), false,
                          [scene, error] { return plan_totals(scene, error); }});
  }
}

}  // namespace

std::vector<Contender> make_contenders(const ComparedScene& scene) {
  std::vector<Contender> contenders;
  add_rays(scene, contenders);
  add_walks(scene, contenders);
  for (const ScreenSpaceMethod& method : screen_space_methods()) {
    contenders.push_back({method.name, method.parameters, method.shown,
                          [scene, &method] { return run_screen_space(scene, method); }});
  }
  return contenders;
}

}  // namespace heightlight
