#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/stopwatch.h"
#include "heightlight/surface.h"
#include "heightlight/watch.h"
#include "terrain/terrain_truth.h"

namespace heightlight {

/// One definition as a method finds it.
struct FoundSky {
  TerrainSky definition = TerrainSky::sky_view_factor;
  std::vector<double> values;  ///< of the truth's receivers
  Cost cost;                   ///< of the whole map, of that definition alone
};

/// Names of methods.
inline constexpr const char* kRayMarchMethod = "nearest cell (way along the ray)";
inline constexpr const char* kCellMarchMethod = "nearest cell (distance of the cell)";
inline constexpr const char* kWalkMethod = "horizon walk";
inline constexpr const char* kExactHorizonMethod = "exact horizons";
inline constexpr const char* kPlannedMethod = "planned walk";

/// A method with its parameters.
struct TerrainMethod {
  std::string name;
  int azimuths = 0;  ///< 0: chosen for the error
  int reach = 0;     ///< in steps of a cell; 0: as far as the map goes
  double error = 0;  ///< RMSE wanted; 0: none is
  std::function<std::vector<FoundSky>()> run;
};

/// How far a definition is from the truth, found so.
struct DefinitionError {
  double rmse = 0;
  double bias = 0;
  double p95 = 0;  ///< 95 % of the receivers err by no more
};

/// Over at least one difference; they are reordered.
DefinitionError measure_differences(std::vector<double>& differences);

/// One line of the table.
struct TerrainMethodRow {
  std::string method = {};
  int azimuths = 0;
  int reach = 0;
  double error_wanted = 0;
  TerrainSky definition = TerrainSky::sky_view_factor;
  Cost cost = {};
  double per_megatexel = 0;  ///< core-seconds
  DefinitionError error = {};
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
