#pragma once

#include <vector>

#include "visibility/exact_walk.h"
#include "visibility/horizon_sums.h"
#include "visibility/walk_route.h"

namespace heightlight {

/// Finds the means per receiver by fast walks along the azimuths of `options`: one map per entry of `means`.
/// A maximum distance is taken to be sharp. NaN where the sample is missing.
std::vector<Map> walk_horizon_means(const Surface& surface, const HeightPyramid& pyramid,
                                    const WalkOptions& options, const std::vector<HorizonMean>& means,
                                    const std::optional<MaximumDistance>& maximum_distance,
                                    const Watch& watch = {});

/// All kinds of means for the receivers of a square of WalkTile::kWideGroup a side, row by row.
using HorizonBlock =
    HorizonTerms<std::array<float, std::size_t{WalkTile::kWideGroup} * WalkTile::kWideGroup>>;

/// Finds all kinds of means by fast walks, but only for the squares of receivers in `blocks`. Their side is
/// WalkTile::kWideGroup, and their first rows and columns are multiples of it. A maximum distance is taken to
/// be sharp. Missing samples are not marked.
std::vector<HorizonBlock> walk_horizon_blocks(const Surface& surface, const HeightPyramid& pyramid,
                                              const WalkOptions& options,
                                              const std::vector<TileFrame>& blocks,
                                              const std::optional<MaximumDistance>& maximum_distance,
                                              const Watch& watch);

/// All kinds of means for one receiver that is present, by exact walks.
HorizonTerms<double> exact_horizon_means(const ExactWalker& walker, int row, int column);

/// The terms whose means exact_horizon_means returns: one entry per azimuth of the walker.
std::vector<HorizonTerms<double>> exact_horizon_terms(const ExactWalker& walker, int row, int column);

}  // namespace heightlight
