#pragma once

#include <cstdint>

#include "bake/bake.h"

namespace heightlight {

/// Maps that follow from the heights around a texel. Empty where no map wants them.
struct LocalMaps {
  double scale = 0;            ///< standard deviation of the Gaussian mean, world units
  Map curvature;               ///< mean curvature of that mean, 1/world length, convex positive
  double curvature_range = 1;  ///< > 0: what files of integers hold of it, either way; few texels exceed it
  Map cavity;                  ///< height above that mean, over the scale
  double cavity_range = 1;
};

/// Whether a map is one of these.
bool is_local(MaterialMap map);

/// Finds those that are wanted, and nothing else.
LocalMaps find_local_maps(const Surface& surface, const BakeOptions& options);

/// Bytes per texel that they keep, and those that finding them takes with that.
std::uint64_t kept_local_bytes(const BakeOptions& options);
std::uint64_t passing_local_bytes(const BakeOptions& options);

/// A unit of displacement: its name, and how many of it are a metre.
struct LengthUnit {
  const char* name;
  double per_metre;
};
LengthUnit unit_of(DisplacementUnit unit);

}  // namespace heightlight
