#pragma once

#include <algorithm>
#include <cmath>

#include "heightlight/transport.h"

namespace heightlight {

/// Largest |sky + F 1 − 1| over the receivers: what a gather of ones leaves.
inline double gathered_ones_error(const Transport& transport) {
  const TexelVector gathered = transport.gather(TexelVector(transport.direct.size(), 1.0));
  double worst = 0;
  for (std::size_t i = 0; i < gathered.size(); ++i) {
    if (std::isnan(transport.sky_view_factor.values[i])) continue;
    worst = std::max(worst, std::fabs(transport.direct[i] + gathered[i] - 1));
  }
  return worst;
}

}  // namespace heightlight
