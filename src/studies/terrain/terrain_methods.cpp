#include "terrain/terrain_methods.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/percentile.h"
#include "base/progress.h"
#include "heightlight/solve.h"
#include "terrain/horizon_means.h"

namespace heightlight {
namespace {

constexpr int kTriedAzimuths[] = {8, 16, 32, 64};
constexpr int kReaches[] = {10, 50, 100, 1000, 0};  // cells; 0: all
constexpr double kErrors[] = {0.01, 0.003, 0.001};

std::vector<TerrainSky> all_definitions() {
  std::vector<TerrainSky> definitions;
  for (const TerrainSkyText& text : terrain_skies()) definitions.push_back(text.definition);
  return definitions;
}

std::vector<double> values_at(const Map& map, const std::vector<std::size_t>& receivers) {
  std::vector<double> values;
  values.reserve(receivers.size());
  for (const std::size_t texel : receivers) values.push_back(double{map.values[texel]});
  return values;
}

std::vector<FoundSky> at_receivers(const std::vector<DefinitionMap>& maps, const TerrainTruth& truth) {
  std::vector<FoundSky> found;
  for (const DefinitionMap& one : maps)
    found.push_back({one.definition, values_at(one.map, truth.receivers), one.cost});
  return found;
}

/// The usual algorithm; a reach that no texel's ray is longer than is that of the whole map.
void add_marches(const Surface& surface, const TerrainTruth& truth, std::vector<TerrainMethod>& methods) {
  for (const CellDistance distance : {CellDistance::along_ray, CellDistance::to_cell}) {
    const bool is_along = distance == CellDistance::along_ray;
    for (const int azimuths : kTriedAzimuths) {
      for (const int reach : kReaches) {
        if (reach >= std::max(surface.width(), surface.height())) continue;
        methods.push_back({.name = is_along ? kRayMarchMethod : kCellMarchMethod,
                           .azimuths = azimuths,
                           .reach = reach,
                           .run = [&surface, &truth, azimuths, reach, distance] {
                             const MarchOptions march{.reach = reach, .distance = distance};
                             return at_receivers(
                                 march_definitions(surface, azimuths, march, all_definitions()), truth);
                           }});
      }
    }
  }
}

/// Exact horizons are found one receiver after the other, so that the truth's tell what all would cost. Each
/// definition is found alone.
std::vector<FoundSky> walk_exactly(const Surface& surface, const TerrainTruth& truth, int azimuths,
                                   const Watch& watch) {
  const double texels = static_cast<double>(surface.map.height.size() - count_missing(surface.map));
  const double times = texels / static_cast<double>(truth.receivers.size());
  std::vector<FoundSky> found;
  for (const TerrainSky definition : all_definitions()) {
    const Stopwatch stopwatch;
    auto values = find_exact_definitions(surface, azimuths, truth.receivers, {definition}, watch);
    found.push_back({definition, std::move(values[0]), times * stopwatch.elapsed()});
  }
  return found;
}

std::vector<FoundSky> solve_sky(const Surface& surface, const TerrainTruth& truth, double error,
                                const Watch& watch) {
  Request request;
  request.wanted.sky = true;
  request.accuracy.error = error;
  request.checks.sky = false;
  request.watch = watch;
  const Stopwatch stopwatch;
  const Results results = solve(surface, request);
  return {{TerrainSky::sky_view_factor, values_at(results.sky_view_factor, truth.receivers),
           stopwatch.elapsed()}};
}

/// The least of up to three runs' costs, as least_cost has it.
std::vector<FoundSky> run_timed(const TerrainMethod& method) {
  std::vector<FoundSky> found;
  least_cost([&] {
    std::vector<FoundSky> again = method.run();
    for (std::size_t d = 0; d < found.size(); ++d) {
      if (found[d].cost.core < again[d].cost.core) again[d].cost = found[d].cost;
    }
    found = std::move(again);
  });
  return found;
}

}  // namespace

DefinitionError measure_differences(std::vector<double>& differences) {
  DefinitionError error;
  double squares = 0;
  for (double& difference : differences) {
    error.bias += difference;
    squares += difference * difference;
    difference = std::fabs(difference);
  }
  const auto count = static_cast<double>(differences.size());
  error.bias /= count;
  error.rmse = std::sqrt(squares / count);
  error.p95 = percentile(std::span(differences), 0.95);
  return error;
}

std::string parameters_of(const TerrainMethodRow& row) {
  if (row.error_wanted > 0) return fmt::format("error {:g}", row.error_wanted);
  return row.reach > 0 ? fmt::format("{} azimuths, {} cells", row.azimuths, row.reach)
                       : fmt::format("{} azimuths", row.azimuths);
}

std::vector<TerrainMethod> terrain_methods(const Surface& surface, const TerrainTruth& truth,
                                           const Watch& watch) {
  std::vector<TerrainMethod> methods;
  add_marches(surface, truth, methods);
  const Watch quiet{.tell = {}, .stopped = watch.stopped};
  for (const int azimuths : kTriedAzimuths) {
    methods.push_back({.name = kWalkMethod, .azimuths = azimuths, .run = [&surface, &truth, azimuths, quiet] {
                         return at_receivers(walk_definitions(surface, azimuths, all_definitions(), quiet),
                                             truth);
                       }});
  }
  for (const int azimuths : kTriedAzimuths) {
    methods.push_back(
        {.name = kExactHorizonMethod, .azimuths = azimuths, .run = [&surface, &truth, azimuths, quiet] {
           return walk_exactly(surface, truth, azimuths, quiet);
         }});
  }
  for (const double error : kErrors) {
    methods.push_back({.name = kPlannedMethod, .error = error, .run = [&surface, &truth, error, quiet] {
                         return solve_sky(surface, truth, error, quiet);
                       }});
  }
  return methods;
}

std::vector<TerrainMethodRow> compare_terrain_methods(const Surface& surface, const TerrainTruth& truth,
                                                      const Watch& watch) {
  const std::vector<TerrainMethod> methods = terrain_methods(surface, truth, watch);
  const double megatexels = static_cast<double>(surface.map.height.size()) / 1e6;
  std::vector<TerrainMethodRow> rows;
  Progress progress("methods", static_cast<std::int64_t>(methods.size()), watch);
  for (const TerrainMethod& method : methods) {
    progress.throw_if_stopped();
    for (FoundSky& found : run_timed(method)) {
      const std::vector<double>& exact = truth.of(found.definition);
      for (std::size_t i = 0; i < exact.size(); ++i) found.values[i] -= exact[i];
      rows.push_back({.method = method.name,
                      .azimuths = method.azimuths,
                      .reach = method.reach,
                      .error_wanted = method.error,
                      .definition = found.definition,
                      .cost = found.cost,
                      .per_megatexel = found.cost.core / megatexels,
                      .error = measure_differences(found.values)});
    }
    progress.add(1);
  }
  return rows;
}

}  // namespace heightlight
