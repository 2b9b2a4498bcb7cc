#pragma once

#include <cstdint>
#include <vector>

#include "terrain/terrain_trial.h"

namespace heightlight {

/// All that a study of terrain finds.
struct TerrainStudy {
  TrialOptions options;
  TerrainTrial trial;
  std::size_t receivers = 0;  ///< on which methods were compared
  std::vector<TerrainMethodRow> methods;
};

/// Bytes per texel that a study holds beside what finding the truth takes.
std::uint64_t study_bytes_per_texel(std::size_t albedos);

/// Formulas of what terrain reflects beside light transport, and the usual algorithms for sky view factors
/// beside exact horizons. Throws UsageError for a map that is not open, an albedo outside [0, 1] or a sun
/// that cannot be; what solve throws.
TerrainStudy study_terrain(const Surface& surface, TrialOptions options);

}  // namespace heightlight
