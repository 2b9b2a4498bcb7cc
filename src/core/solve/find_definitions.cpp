#include <utility>

#include "solve/definitions.h"
#include "solve/reference_sky.h"

namespace heightlight {
namespace {

/// The surface seen from below. What is level tilts the other way, as a surface of the opposite curvature has
/// it.
Surface turn_upside_down(const Surface& surface) {
  Heightmap map = surface.map;
  for (float& height : map.height.values) height = surface.highest - height;
  map.base = 0;
  map.curvature = -map.curvature;
  return build_surface(std::move(map));
}

/// Finds the definitions whose places in the request are given, all of them means of one surface's horizons.
void find_means(const Task& task, const Surface& surface, const std::vector<std::size_t>& places,
                Results& results) {
  const Request& request = task.request;
  Evidence& evidence = results.evidence;
  MeansGoal goal{.means = {},
                 .error = request.accuracy.error,
                 .azimuths = request.accuracy.azimuths,
                 .maximum_distance = request.wanted.maximum_distance,
                 .seed = request.accuracy.seed};
  for (const std::size_t i : places) goal.means.push_back(mean_of(request.wanted.definitions[i]));
  std::vector<Map> found;
  int azimuths = evidence.azimuths;
  if (request.accuracy.visibility == Visibility::exact_slices) {
    found = slice_horizon_means(surface, azimuths, goal.means, goal.maximum_distance, request.watch);
  } else {
    const HeightPyramid pyramid = build_height_pyramid(surface);
    const WalkOptions walk = plan_horizon_means(surface, pyramid, goal, request.watch);
    azimuths = walk.azimuths;
    found = walk_horizon_means(surface, pyramid, walk, goal.means, goal.maximum_distance, request.watch);
  }
  std::vector<double> errors;
  if (request.checks.sky) errors = check_horizon_means(surface, found, goal, request.watch);
  for (std::size_t k = 0; k < places.size(); ++k) {
    evidence.definition_checks[places[k]].azimuths = azimuths;
    if (!errors.empty()) evidence.definition_checks[places[k]].rmse = errors[k];
    results.definitions[places[k]] = std::move(found[k]);
  }
}

}  // namespace

HorizonMean mean_of(SkyDefinition definition) {
  switch (definition) {
    case SkyDefinition::svf_horizontal:
      return HorizonMean::squared_cosine;
    case SkyDefinition::svf_solid_angle:
      return HorizonMean::one_less_sine;
    case SkyDefinition::mean_cos_h:
      return HorizonMean::cosine;
    default:
      return HorizonMean::zenith_angle;
  }
}

bool is_of_sky(SkyDefinition definition) {
  return definition == SkyDefinition::svf_tilted || definition == SkyDefinition::terrain_view_factor;
}

void find_definitions(const Task& task, Results& results) {
  const std::vector<SkyDefinition>& wanted = task.request.wanted.definitions;
  results.definitions.resize(wanted.size());
  std::vector<std::size_t> upright;
  std::vector<std::size_t> upside_down;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    results.evidence.definition_checks.push_back({.definition = wanted[i]});
    if (is_of_sky(wanted[i])) continue;
    (wanted[i] == SkyDefinition::openness_negative ? upside_down : upright).push_back(i);
  }
  if (!upright.empty()) find_means(task, task.surface, upright, results);
  if (!upside_down.empty()) find_means(task, turn_upside_down(task.surface), upside_down, results);
}

void take_definitions_of_sky(const Task& task, Results& results) {
  const std::vector<SkyDefinition>& wanted = task.request.wanted.definitions;
  const Evidence& evidence = results.evidence;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!is_of_sky(wanted[i])) continue;
    results.definitions[i] = results.sky_view_factor;
    if (wanted[i] == SkyDefinition::terrain_view_factor) {
      for (float& share : results.definitions[i].values) share = 1 - share;
    }
    DefinitionCheck& check = results.evidence.definition_checks[i];
    check.azimuths = evidence.azimuths;
    if (evidence.sky_check) check.rmse = evidence.sky_check->sky_view_factor;
  }
}

}  // namespace heightlight
