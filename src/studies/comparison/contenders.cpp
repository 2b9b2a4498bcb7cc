#include "comparison/contenders.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "heightlight/solve.h"

namespace heightlight {
namespace {

/// What `simulate` or `bake` would find, without evidence: what that costs is not the method's.
Estimate solve_scene(const ComparedScene& scene, const Wanted& wanted, const Accuracy& accuracy) {
  Request request{.wanted = wanted, .accuracy = accuracy};
  request.checks = {.sky = false, .totals = false, .energy = false, .bounces = false};
  request.limits.memory = scene.memory;
  Results results = solve(scene.surface, request);
  Estimate estimate;
  estimate.sky_view_factor = std::move(results.sky_view_factor);
  estimate.ambient_occlusion = std::move(results.ambient_occlusion);
  for (const std::vector<TexelVector>& channels : results.totals) {
    estimate.totals.push_back(to_map(channels[0], scene.surface));
  }
  estimate.samples_per_texel = results.evidence.rays;
  return estimate;
}

Accuracy by_rays(const ComparedScene& scene, int count) {
  return {.visibility = Visibility::rays, .rays = count, .seed = scene.seed};
}

/// Every azimuth from every receiver.
Accuracy by_fixed_walk(const ComparedScene& scene, const WalkOptions& walk) {
  return {.seed = scene.seed, .plan = HorizonPlan{.sky = {.walk = walk}}};
}

Estimate find_sky_alone(const ComparedScene& scene, const Accuracy& accuracy) {
  return solve_scene(scene, {.sky = true}, accuracy);
}

/// The totals, and nothing else: what finding A alone costs is another contender's.
Estimate find_totals_alone(const ComparedScene& scene, const Accuracy& accuracy,
                           const std::vector<ComparedAlbedo>& albedos) {
  Wanted wanted;
  for (const ComparedAlbedo& albedo : albedos) wanted.totals.push_back(albedo.albedo());
  return solve_scene(scene, wanted, accuracy);
}

Estimate run_screen_space(const ComparedScene& scene, const ScreenSpaceMethod& method,
                          const std::vector<ComparedAlbedo>& compared) {
  std::vector<SurfaceAlbedo> albedos;
  for (const ComparedAlbedo& albedo : compared)
    albedos.push_back(
        {.constant = albedo.reflectance[0], .map = albedo.constant() ? nullptr : &albedo.varying});
  ScreenSpaceView view = method.run(scene.depth, albedos);
  Estimate estimate;
  estimate.sky_view_factor = std::move(view.sky_view_factor);
  estimate.ambient_occlusion = std::move(view.ambient_occlusion);
  estimate.bent_normal = std::move(view.bent_normal);
  estimate.seen = std::move(view.seen);
  estimate.totals = std::move(view.totals);
  estimate.samples_per_texel = view.samples_per_texel;
  return estimate;
}

/// A contender that finds A and α, as horizon walks and rays do together.
Contender sky_contender(const ComparedScene& scene, const std::string& method, const std::string& parameters,
                        const Accuracy& accuracy) {
  return {.method = method, .parameters = parameters, .run = [scene, accuracy](const auto&) {
            return find_sky_alone(scene, accuracy);
          }};
}

Contender totals_contender(const ComparedScene& scene, const std::string& method,
                           const std::string& parameters, const Accuracy& accuracy) {
  return {.method = method,
          .parameters = parameters,
          .finds_occlusion = false,
          .finds_totals = true,
          .run = [scene, accuracy](const std::vector<ComparedAlbedo>& albedos) {
            return find_totals_alone(scene, accuracy, albedos);
          }};
}

void add_rays(const ComparedScene& scene, std::vector<Contender>& contenders) {
  for (const int count : {4, 16, 64, 256}) {
    contenders.push_back(sky_contender(scene, "rays", fmt::format("{} rays", count), by_rays(scene, count)));
    contenders.back().shown = count == 64;
  }
  for (const int count : {16, 64, 256}) {
    contenders.push_back(
        totals_contender(scene, "rays with links", fmt::format("{} rays", count), by_rays(scene, count)));
  }
}

void add_walks(const ComparedScene& scene, std::vector<Contender>& contenders) {
  for (const auto& [azimuths, samples_per_octave] :
       {std::pair{4, 8}, {8, 8}, {16, 8}, {16, 16}, {32, 16}, {64, 32}}) {
    const WalkOptions walk{
        .azimuths = azimuths, .samples_per_octave = samples_per_octave, .peak_share = 0.3F};
    contenders.push_back(sky_contender(scene, "horizon walk",
                                       fmt::format("{} azimuths; fineness {}", azimuths, samples_per_octave),
                                       by_fixed_walk(scene, walk)));
    if (azimuths != 8) continue;
    contenders.back().shown = true;
    contenders.back().role = "horizon walk";
  }
  const auto planned = [&](double error) { return Accuracy{.error = error, .seed = scene.seed}; };
  for (const double error : {0.01, 0.005, 0.002, 0.001}) {
    contenders.push_back(
        sky_contender(scene, "horizon walk planned", fmt::format("error {:g}", error), planned(error)));
  }
  for (const double error : {0.02, 0.01, 0.005, 0.002}) {
    contenders.push_back(totals_contender(scene, "horizon walk with bounces",
                                          fmt::format("error {:g}", error), planned(error)));
  }
}

/// Jimenez et al. 2016, section 4.3: near occlusion by GTAO, fading over the outer half of its radius, and
/// the baked one of what is far, "by calculating their minimum". The baking is nobody's time.
Estimate run_near_and_far(const ComparedScene& scene, double radius) {
  GtaoOptions options;
  options.radius = scene.depth.relief > 0 ? radius * scene.depth.relief : options.radius;
  options.falloff = 0.5;
  ScreenSpaceView view = gtao(scene.depth, options);
  Estimate estimate;
  estimate.sky_view_factor = std::move(view.sky_view_factor);
  for (std::size_t i = 0; i < estimate.sky_view_factor.size(); ++i) {
    float& sky = estimate.sky_view_factor.values[i];
    sky = std::min(sky, scene.far_field->values[i]);
  }
  estimate.samples_per_texel = view.samples_per_texel;
  return estimate;
}

void add_near_and_far(const ComparedScene& scene, std::vector<Contender>& contenders) {
  if (!scene.far_field) return;
  for (const double radius : {0.25, 0.5, 1.0}) {
    contenders.push_back(
        {.method = "gtao near with baked far",
         .parameters = fmt::format("3 x 3; reach {:g}; 16 turns; falloff 0.5; far at 1/8", radius),
         .run = [scene, radius](const auto&) { return run_near_and_far(scene, radius); }});
  }
}

}  // namespace

std::vector<Contender> make_contenders(const ComparedScene& scene) {
  std::vector<Contender> contenders;
  add_rays(scene, contenders);
  add_walks(scene, contenders);
  for (const ScreenSpaceMethod& method : screen_space_methods()) {
    contenders.push_back({.method = method.name,
                          .parameters = method.parameters,
                          .shown = method.shown,
                          .role = method.role,
                          .directions = method.directions,
                          .finds_totals = method.finds_totals,
                          .prepare = method.prepare,
                          .run = [scene, &method](const std::vector<ComparedAlbedo>& albedos) {
                            return run_screen_space(scene, method, albedos);
                          }});
    if (!method.run_under_sky) continue;
    contenders.back().sky_solid_angle = method.sky_solid_angle;
    contenders.back().run_under_sky = [scene, &method](const SkyGrid& sky) {
      return method.run_under_sky(scene.depth, sky);
    };
  }
  add_near_and_far(scene, contenders);
  return contenders;
}

std::vector<std::string> shown_methods() {
  // Nothing of the scene is looked at before a method runs.
  const Surface surface;
  const DepthBuffer depth;
  const std::vector<ComparedAlbedo> albedos;
  std::vector<std::string> names;
  for (const Contender& contender :
       make_contenders({.surface = surface, .depth = depth, .albedos = albedos})) {
    if (contender.shown) names.push_back(contender.method);
  }
  return names;
}

}  // namespace heightlight
