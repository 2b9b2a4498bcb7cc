#pragma once

#include <vector>

#include "transport/map_gather.h"

namespace heightlight {

/// What gathers of single fields share, and who they are for.
struct FieldGather {
  const MapGather& gather;
  const Map& sky;             ///< A
  const TexelVector& direct;  ///< A as F complements it to 1, 0 where missing
  const Watch& watch;
};

/// F x, where x is finite everywhere. 0 where missing.
TexelVector gather_field(const FieldGather& gather, const TexelVector& x, GatherTurn turn);

/// The share of what a receiver could see that is surface, as the walks add it up. 0 where missing.
TexelVector find_surface_share(const FieldGather& gather, const GatherTurn& turn);

}  // namespace heightlight
