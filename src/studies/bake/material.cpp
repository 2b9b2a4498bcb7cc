#include "bake/material.h"

#include <algorithm>

#include "bake/bake_memory.h"
#include "base/stopwatch.h"

namespace heightlight {
namespace {

MaterialMap map_of(SkyDefinition definition) {
  return static_cast<MaterialMap>(static_cast<int>(MaterialMap::svf_tilted) + static_cast<int>(definition));
}

/// Azimuths of a horizon map, rad, counterclockwise from x. Those from x count toward the y of the files.
std::vector<double> horizon_azimuths(const BakeOptions& options, AzimuthConvention convention) {
  std::vector<double> azimuths = equal_azimuths(options.horizon_azimuths, convention);
  if (options.y_down && convention == AzimuthConvention::math) {
    for (double& azimuth : azimuths) azimuth = -azimuth;
  }
  return azimuths;
}

/// What two channels lose, at the albedos whose totals come last.
std::vector<ModelError> judge_model(const Results& results) {
  const std::vector<double>& albedos = checked_albedos();
  const std::size_t first = results.totals.size() - albedos.size();
  std::vector<ModelError> errors;
  for (std::size_t i = 0; i < albedos.size(); ++i) {
    errors.push_back(judge_model_map(results.whole_sky_view_factor, results.seen,
                                     results.totals[first + i][0], albedos[i]));
  }
  return errors;
}

}  // namespace

AzimuthConvention azimuth_convention(const BakeOptions& options, Boundary boundary) {
  const bool tiles = boundary == Boundary::tile;
  return options.azimuth_convention.value_or(tiles ? AzimuthConvention::math : AzimuthConvention::north);
}

bool is_wanted(const BakeOptions& options, MaterialMap map) {
  const bool is_on_sheet =
      map == MaterialMap::ao || map == MaterialMap::bent_normal || map == MaterialMap::multibounce;
  if (options.draw_sheet && is_on_sheet) return true;
  return std::find(options.maps.begin(), options.maps.end(), map) != options.maps.end() ||
         std::any_of(options.packed.begin(), options.packed.end(), [map](const PackedTexture& pack) {
           return std::any_of(pack.channels.begin(), pack.channels.end(),
                              [map](const PackedChannel& channel) { return channel.map == map; });
         });
}

Request material_request(const BakeOptions& options, AzimuthConvention convention) {
  const auto has = [&](MaterialMap map) { return is_wanted(options, map); };
  Request request;
  Wanted& wanted = request.wanted;
  wanted.moments.second = has(MaterialMap::sh);
  wanted.moments.first =
      wanted.moments.second || has(MaterialMap::bent_normal) || has(MaterialMap::bent_cone);
  wanted.sky = wanted.moments.first || has(MaterialMap::ao);
  wanted.maximum_distance = options.maximum_distance;
  wanted.below = options.below;
  for (const SkyDefinitionFacts& facts : sky_definitions()) {
    if (has(map_of(facts.definition))) wanted.definitions.push_back(facts.definition);
  }
  if (has(MaterialMap::horizon)) wanted.horizon_rad = horizon_azimuths(options, convention);
  if (has(MaterialMap::multibounce)) wanted.totals.push_back(options.albedo);
  wanted.seen = has(MaterialMap::ao_n);
  if (wanted.seen) {
    for (const double albedo : checked_albedos()) wanted.totals.push_back({.constant = {albedo}});
  }
  request.accuracy = {.error = options.error, .azimuths = options.azimuths, .seed = options.seed};
  request.checks.totals = has(MaterialMap::multibounce);
  request.limits.memory = options.memory;
  request.watch = options.watch;
  return request;
}

Material find_material(const Surface& surface, const BakeOptions& options) {
  Request request = material_request(options, azimuth_convention(options, surface.map.boundary));
  const std::uint64_t beside = bytes_beside_solution(surface.width(), surface.height(), options);
  request.limits.memory -= std::min(request.limits.memory, beside);
  Material material;
  material.surface = &surface;
  material.local = find_local_maps(surface, options);
  const bool is_lit = is_wanted(options, MaterialMap::multibounce) || is_wanted(options, MaterialMap::direct);
  if (options.light_channels > 0 && is_lit) {
    material.light = options.find_light(surface);
    if (!request.wanted.totals.empty()) request.wanted.direct = material.light.channels;
  }
  if (is_wanted(options, MaterialMap::specular_occlusion))
    material.specular = specular_occlusion(surface, {.gloss = options.gloss,
                                                     .view = options.view,
                                                     .rays = 0,
                                                     .error = options.error,
                                                     .seed = options.seed,
                                                     .watch = options.watch});
  material.results = solve(surface, request);
  Stopwatch watch;
  if (request.wanted.seen) material.model_errors = judge_model(material.results);
  material.results.evidence.seconds.check += watch.lap();
  if (is_wanted(options, MaterialMap::multibounce)) {
    for (const TexelVector& total : material.results.totals[0])
      material.totals.push_back(to_map(total, surface));
  }
  material.results.totals.clear();
  return material;
}

}  // namespace heightlight
