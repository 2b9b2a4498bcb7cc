#pragma once

#include "heightlight/error.h"
#include "heightlight/heightmap.h"

namespace heightlight {

/// Correlations below leave more than half of what varies to something else.
constexpr double kPoorMatch = 0.7;

inline void refuse_level_match(const Heightmap& map) {
  if (relief(map) == 0) throw UsageError("match", "", "wants a heightmap that is not level");
}

}  // namespace heightlight
