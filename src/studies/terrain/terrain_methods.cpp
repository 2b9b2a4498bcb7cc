#include "terrain/terrain_methods.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/percentile.h"
#include "base/progress.h"
#include "heightlight/solve.h"
#include "terrain/marched_quantities.h"

namespace heightlight {
namespace {

constexpr int kTriedAzimuths[] = {8, 16, 32, 64};
constexpr int kCells[] = {10, 50, 100, 1000, 0};  // cells; 0: all
constexpr double kErrors[] = {0.01, 0.003, 0.001};

std::vector<double> values_at(const Map& map, const std::vector<std::size_t>& receivers) {
  std::vector<double> values;
  values.reserve(receivers.size());
  for (const std::size_t texel : receivers) values.push_back(double{map.values[texel]});
  return values;
}

std::vector<FoundQuantity> march(const Surface& surface, const TerrainTruth& truth, int azimuths,
                                 const MarchOptions& options) {
  std::vector<FoundQuantity> found;
  for (const QuantityMap& one : march_quantities(surface, azimuths, options, terrain_quantities()))
    found.push_back({one.quantity, values_at(one.map, truth.receivers), one.cost});
  return found;
}

/// The usual algorithm; a number of cells that no texel's ray is longer than is that of the whole map.
void add_marches(const Surface& surface, const TerrainTruth& truth, std::vector<TerrainMethod>& methods) {
  for (const CellDistance distance : {CellDistance::along_ray, CellDistance::to_cell}) {
    const bool is_along = distance == CellDistance::along_ray;
    for (const int azimuths : kTriedAzimuths) {
      for (const int cells : kCells) {
        if (cells >= std::max(surface.width(), surface.height())) continue;
        methods.push_back({.name = is_along ? kRayMarchMethod : kCellMarchMethod,
                           .azimuths = azimuths,
                           .cells = cells,
                           .run = [&surface, &truth, azimuths, cells, distance] {
                             return march(surface, truth, azimuths, {.cells = cells, .distance = distance});
                           }});
      }
    }
  }
}

/// Exact horizons are found one receiver after the other, so that the truth's tell what all would cost. Each
/// quantity is found alone.
std::vector<FoundQuantity> walk_exactly(const Surface& surface, const TerrainTruth& truth, int azimuths,
                                        const Watch& watch) {
  const double texels = static_cast<double>(surface.map.height.size() - count_missing(surface.map));
  const double times = texels / static_cast<double>(truth.receivers.size());
  std::vector<FoundQuantity> found;
  for (const TerrainQuantity& quantity : terrain_quantities()) {
    const Stopwatch stopwatch;
    std::vector<double> values = find_exactly(surface, azimuths, truth.receivers, quantity, watch);
    found.push_back({quantity, std::move(values), times * stopwatch.elapsed()});
  }
  return found;
}

/// Each quantity alone, with its plan.
std::vector<FoundQuantity> walk(const Surface& surface, const TerrainTruth& truth, const Accuracy& accuracy,
                                const Watch& watch) {
  std::vector<FoundQuantity> found;
  for (const TerrainQuantity& quantity : terrain_quantities()) {
    const Request request{.wanted = {.definitions = {quantity.definition}, .below = quantity.below},
                          .accuracy = accuracy,
                          .checks = {.sky = false},
                          .watch = watch};
    const Stopwatch stopwatch;
    const Results results = solve(surface, request);
    found.push_back({quantity, values_at(results.definitions[0], truth.receivers), stopwatch.elapsed()});
  }
  return found;
}

/// The least of up to three runs' costs, as least_cost has it.
std::vector<FoundQuantity> run_timed(const TerrainMethod& method) {
  std::vector<FoundQuantity> found;
  least_cost([&] {
    std::vector<FoundQuantity> again = method.run();
    for (std::size_t d = 0; d < found.size(); ++d) {
      if (found[d].cost.core < again[d].cost.core) again[d].cost = found[d].cost;
    }
    found = std::move(again);
  });
  return found;
}

}  // namespace

QuantityError measure_differences(std::vector<double>& differences) {
  QuantityError error;
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
  return row.cells > 0 ? fmt::format("{} azimuths, {} cells", row.azimuths, row.cells)
                       : fmt::format("{} azimuths", row.azimuths);
}

std::vector<TerrainMethod> terrain_methods(const Surface& surface, const TerrainTruth& truth,
                                           const Watch& watch) {
  std::vector<TerrainMethod> methods;
  add_marches(surface, truth, methods);
  const Watch quiet{.tell = {}, .stopped = watch.stopped};
  const auto add_walk = [&](const char* name, int azimuths, double error) {
    const Accuracy accuracy{.error = error > 0 ? error : kErrorOfGivenAzimuths, .azimuths = azimuths};
    methods.push_back(
        {.name = name, .azimuths = azimuths, .error = error, .run = [&surface, &truth, accuracy, quiet] {
           return walk(surface, truth, accuracy, quiet);
         }});
  };
  for (const int azimuths : kTriedAzimuths) add_walk(kWalkMethod, azimuths, 0);
  for (const int azimuths : kTriedAzimuths) {
    methods.push_back(
        {.name = kExactHorizonMethod, .azimuths = azimuths, .run = [&surface, &truth, azimuths, quiet] {
           return walk_exactly(surface, truth, azimuths, quiet);
         }});
  }
  for (const double error : kErrors) add_walk(kPlannedMethod, 0, error);
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
    for (FoundQuantity& found : run_timed(method)) {
      const std::vector<double>& exact = truth.of(found.quantity);
      for (std::size_t i = 0; i < exact.size(); ++i) found.values[i] -= exact[i];
      rows.push_back({.method = method.name,
                      .azimuths = method.azimuths,
                      .cells = method.cells,
                      .error_wanted = method.error,
                      .quantity = found.quantity,
                      .cost = found.cost,
                      .per_megatexel = found.cost.core / megatexels,
                      .error = measure_differences(found.values)});
    }
    progress.add(1);
  }
  return rows;
}

}  // namespace heightlight
