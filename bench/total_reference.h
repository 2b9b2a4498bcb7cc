#pragma once

#include <cstdint>

#include "time_to_error.h"

namespace heightlight {

/// Options for a converged total irradiance. It is made by a final gather: the map is solved with
/// `field_rays` per texel, then some receivers gather from it with 65536 rays each, so that the solution's
/// noise is averaged away.
struct TotalReferenceOptions {
  double albedo = 0.8;
  int receivers = 512;
  int field_rays = 512;
  std::uint64_t seed = 101;
};

/// Total irradiance / π: A + ρ Σ weight · E(hit point).
ReferenceValues make_total_reference(const Surface& surface, const TotalReferenceOptions& options);

}  // namespace heightlight
