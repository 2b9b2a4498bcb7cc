#pragma once

#include <cstdint>

#include "time_to_error.h"

namespace heightlight {

/// How a converged total irradiance is made: a final gather. The map is solved with `field_rays` per texel;
/// then some receivers look at it with 65536 rays, so that its noise is averaged away.
struct TotalReferenceOptions {
  double albedo = 0.8;
  int receivers = 512;
  int field_rays = 512;
  std::uint64_t seed = 101;
};

/// Total irradiance / π: A + ρ Σ weight · E(place seen).
ReferenceValues make_total_reference(const Surface& surface, const TotalReferenceOptions& options);

}  // namespace heightlight
