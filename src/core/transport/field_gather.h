#pragma once

#include <vector>

#include "transport/map_gather.h"

namespace heightlight {

/// What all gathers of single fields over one map share.
struct FieldGather {
  const MapGather& gather;
  const Map& sky;             ///< A; NaN where missing
  const TexelVector& direct;  ///< A, such that A + Σ F = 1; 0 where missing
  const Watch& watch;
};

/// Returns F x, where x is finite everywhere: (1 − A) times the mean of x that each receiver sees. 0 where
/// missing. `turn.sky` is ignored.
TexelVector gather_field(const FieldGather& gather, const TexelVector& x, GatherTurn turn);

/// Returns Σ F of each receiver as the walks add it up, which need not be exactly 1 − A. 0 where missing.
TexelVector find_surface_share(const FieldGather& gather, const GatherTurn& turn);

}  // namespace heightlight
