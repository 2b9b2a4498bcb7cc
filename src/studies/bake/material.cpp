#include "bake/material.h"

#include <algorithm>
#include <numbers>

#include "base/stopwatch.h"

namespace heightlight {
namespace {

/// Azimuths of a horizon map, rad; they count from x toward the y of the files.
std::vector<double> horizon_azimuths(const BakeOptions& options) {
  std::vector<double> azimuths;
  for (int k = 0; k < options.horizon_azimuths; ++k) {
    azimuths.push_back((options.y_down ? -2 : 2) * std::numbers::pi * k / options.horizon_azimuths);
  }
  return azimuths;
}

Request make_request(const BakeOptions& options) {
  const auto has = [&](MaterialMap map) { return is_wanted(options, map); };
  Request request;
  Wanted& wanted = request.wanted;
  wanted.moments.second = has(MaterialMap::sh);
  wanted.moments.first =
      wanted.moments.second || has(MaterialMap::bent_normal) || has(MaterialMap::bent_cone);
  wanted.sky = wanted.moments.first || has(MaterialMap::ao);
  wanted.reach = options.reach;
  if (has(MaterialMap::horizon)) wanted.horizon_rad = horizon_azimuths(options);
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

bool is_wanted(const BakeOptions& options, MaterialMap map) {
  return std::find(options.maps.begin(), options.maps.end(), map) != options.maps.end() ||
         std::any_of(options.packed.begin(), options.packed.end(),
                     [map](const PackedChannel& channel) { return channel.map == map; });
}

Material find_material(const Surface& surface, const BakeOptions& options) {
  const Request request = make_request(options);
  Material material;
  material.surface = &surface;
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
