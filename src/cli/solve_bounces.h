#pragma once

#include <vector>

#include "cli/albedo.h"
#include "cli/bounce_sink.h"
#include "cli/simulation.h"

namespace heightlight {

/// What all bounces come to, E/π.
struct SolvedBounces {
  TexelVector tail;                 ///< after the last bounce kept apart, at ρ = 1
  std::vector<TexelVector> totals;  ///< of all bounces, one per channel of the albedo
  double deep_seen = 1;             ///< t of the models
};

/// Bounces at ρ = 1, each handed to `sink`, then the tail and the totals: solved for where links are exact,
/// taken from conservation where they are walked. Fills in `energy`, save the rows' sums.
SolvedBounces solve_bounces(const Transport& transport, const Surface& surface, const Albedo& albedo,
                            const SimulateOptions& options, bool by_conservation, BounceSink& sink,
                            EnergyCheck& energy);

}  // namespace heightlight
