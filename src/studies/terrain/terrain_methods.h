#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/stopwatch.h"
#include "heightlight/surface.h"
#include "heightlight/watch.h"
#include "terrain/terrain_truth.h"

namespace heightlight {

/// One quantity as a method finds it.
struct FoundQuantity {
  TerrainQuantity quantity;
  std::vector<double> values;  ///< of the truth's receivers
  Cost cost;                   ///< of the whole map, of that quantity alone
};

/// Names of methods.
inline constexpr const char* kRayMarchMethod = "nearest cell (way along the ray)";
inline constexpr const char* kCellMarchMethod = "nearest cell (distance of the cell)";
inline constexpr const char* kWalkMethod = "horizon walk";
inline constexpr const char* kExactHorizonMethod = "exact horizons";
inline constexpr const char* kPlannedMethod = "planned walk";

/// RMSE that horizon walks along given azimuths aim at but for what few azimuths cost.
inline constexpr double kErrorOfGivenAzimuths = 0.001;

/// A method with its parameters.
struct TerrainMethod {
  std::string name;
  int azimuths = 0;  ///< 0: chosen for the error
  int cells = 0;     ///< in steps of a cell; 0: as far as the map goes
  double error = 0;  ///< RMSE wanted; 0: none is
  std::function<std::vector<FoundQuantity>()> run;
};

/// How far a quantity is from the truth, found so.
struct QuantityError {
  double rmse = 0;
  double bias = 0;
  double p95 = 0;  ///< 95 % of the receivers err by no more
};

/// Over at least one difference; they are reordered.
QuantityError measure_differences(std::vector<double>& differences);

/// One line of the table.
struct TerrainMethodRow {
  std::string method = {};
  int azimuths = 0;
  int cells = 0;
  double error_wanted = 0;
  TerrainQuantity quantity = {};
  Cost cost = {};
  double per_megatexel = 0;  ///< core-seconds
  QuantityError error = {};
};

/// "16 azimuths, 100 cells"
std::string parameters_of(const TerrainMethodRow& row);

/// All that are tried, the usual algorithm first. This is the place to join others. `surface`, which must be
/// open, and the truth must outlive them.
std::vector<TerrainMethod> terrain_methods(const Surface& surface, const TerrainTruth& truth,
                                           const Watch& watch);

/// Runs them all. Methods that take less than a second run up to three times, and the least time counts.
std::vector<TerrainMethodRow> compare_terrain_methods(const Surface& surface, const TerrainTruth& truth,
                                                      const Watch& watch);

}  // namespace heightlight
