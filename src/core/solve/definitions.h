#pragma once

#include "solve/solver.h"
#include "visibility/horizon_means.h"

namespace heightlight {

/// What a definition that is not of A is the mean of.
HorizonMean mean_of(SkyDefinition definition);

/// What horizons are to be found for.
struct MeansGoal {
  std::vector<HorizonMean> means;
  double error = 0;  ///< RMSE wanted of each
  int azimuths = 0;  ///< > 0: fixed
  std::optional<MaximumDistance> maximum_distance = {};
  std::uint64_t seed = 1;  ///< of the receivers that trials are made on
};

/// How fast walks should find the means: by trials on receivers from all over the map, against exact walks.
WalkOptions plan_horizon_means(const Surface& surface, const HeightPyramid& pyramid, const MeansGoal& goal,
                               const Watch& watch);

/// RMSE of maps of the means, [mean asked for], on receivers picked by a hash, against exact walks. Empty
/// where none is present.
std::vector<double> check_horizon_means(const Surface& surface, const std::vector<Map>& found,
                                        const MeansGoal& goal, const Watch& watch);

}  // namespace heightlight
