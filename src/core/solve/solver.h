#pragma once

#include <span>
#include <vector>

#include "heightlight/solve.h"
#include "transport/horizon_check.h"

// The parts of one call, in the order in which they run. Each takes what it needs from the request and puts
// what it finds into the results.

namespace heightlight {

/// A request on its way.
struct Task {
  const Surface& surface;
  const Request& request;
  std::span<const TexelVector> direct = {};  ///< E₀/π of totals; empty: the sky's, as the operator has it
  std::uint64_t free_memory = 0;             ///< bytes that the limit leaves for links, or for a refinement
};

/// Throws UsageError naming the quantity that is out of its range or contradicts another.
void check_request(const Surface& surface, const Request& request);

/// Channels that totals at an albedo have.
std::size_t total_channels(const Wanted& wanted, const Albedo& albedo);

/// Whether anything bounces, so that an operator is needed.
bool needs_operator(const Wanted& wanted);

/// Whether totals are of a sky that has nothing below the horizontal: a direct irradiance of its own, beside
/// the operator's.
bool lights_from_above(const Wanted& wanted);

/// Whether the operator's own sky is the one that was asked for.
bool keeps_sky(const Wanted& wanted);

/// A total that misses the error wanted by more than kMissed (horizon_check.h) misses it by much from here.
constexpr double kMissedByMuch = 1.4;

/// Of the error wanted, for how much of it totals that miss it are found once more.
constexpr double kFiner = 0.7;
constexpr double kMuchFiner = 0.5;

/// Azimuths of exact slices where nobody says.
constexpr int kExactAzimuths = 128;

/// The goal of a plan; `moments`: the sky's moments hang on it.
HorizonGoal plan_goal(const Request& request, bool moments);

/// The operator, and by it bounces, totals and n. The sky comes with it where keeps_sky says so.
void find_irradiance(const Task& task, Results& results);

/// The sky alone, as far as the maximum distance, and horizons, where no operator has found them.
void find_sky(const Task& task, Results& results);

/// Whether a definition is A, or made of it, and not of horizons.
bool is_of_sky(SkyDefinition definition);

/// Whether α, A or moments are to be found.
bool wants_sky(const Wanted& wanted);

/// The definitions that are means of horizons.
void find_definitions(const Task& task, Results& results);

/// Those made of A, once that is found and checked.
void take_definitions_of_sky(const Task& task, Results& results);

/// The operator; with horizon walks for that error, the moments wanted of its sky, and how it walks.
PlannedTransport find_operator(const Task& task, double error, const SkyWanted& moments);

/// Bytes that finding totals once more takes beside estimate_memory: a second operator, and the totals anew.
std::uint64_t refinement_bytes(int width, int height, const Wanted& wanted);

/// Notes what a linear solver did, where the energy is checked.
void note_solver(double residual, int iterations, Evidence& evidence);

/// The totals asked for, checked, and found once more where they miss the error wanted; and E/π at
/// kSeenAlbedo, which is returned, where n or single bounces are wanted.
TexelVector find_totals(const Task& task, const Transport& transport, Results& results);

/// Where the energy of a total went, that is E/π of `system`.
EnergyAudit audit_energy(const Surface& surface, const Transport& transport, const IrradianceSystem& system,
                         const TexelVector& total);

/// Makes all that is received be absorbed or escape, by one factor of what bounces bring. Gathers look from
/// the receivers' side alone, and their errors leave a share of the order of 10⁻⁴ too much or too little over
/// the whole map. Where that would change the total by more than `most_change` RMS, in units of the brightest
/// direct irradiance, samples do not resolve the surface, and the total stays.
void balance_energy(const Surface& surface, const Transport& transport, const IrradianceSystem& system,
                    double most_change, TexelVector& total);

/// t of the closed forms, from E/π at kSeenAlbedo.
double deep_seen(const Transport& transport, const TexelVector& at_seen_albedo);

/// Single bounces into the sink or the results, and the tail.
void solve_bounces(const Task& task, const Transport& transport, Results& results);

}  // namespace heightlight
