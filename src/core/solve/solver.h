#pragma once

#include <vector>

#include "heightlight/solve.h"

// The parts of one call, in the order in which they run. Each takes what it needs from the request and puts
// what it finds into the results.

namespace heightlight {

/// A request on its way.
struct Task {
  const Surface& surface;
  const Request& request;
  std::uint64_t link_memory = 0;  ///< bytes that the limit leaves for links
};

/// Throws UsageError naming the quantity that is out of its range or contradicts another.
void check_request(const Surface& surface, const Request& request);

/// Whether anything bounces, so that an operator is needed.
bool needs_operator(const Wanted& wanted);

/// Whether the operator's own sky is the one that was asked for.
bool keeps_sky(const Wanted& wanted);

/// Azimuths of exact slices where nobody says.
constexpr int kExactAzimuths = 128;

/// The goal of a plan; `total_only` as HorizonGoal has it, `moments`: the sky's moments hang on it.
HorizonGoal plan_goal(const Request& request, bool total_only, bool moments);

/// The operator, and by it bounces, totals and n. The sky comes with it where keeps_sky says so.
void find_light(const Task& task, Results& results);

/// The sky alone, as far as the reach, and horizons, where no operator has found them.
void find_sky(const Task& task, Results& results);

/// Single bounces into the sink or the results, the tail, the totals and n from their sums: what find_light
/// does where they are wanted.
void solve_bounces(const Task& task, const Transport& transport, Results& results);

/// Totals and n without keeping bounces apart: what find_light does otherwise.
void solve_totals_only(const Task& task, const Transport& transport, Results& results);

/// Solves x = direct + F ρ x for every channel of an albedo that varies, or of any with light of one's own.
std::vector<TexelVector> solve_albedo(const Task& task, const Transport& transport, const Albedo& albedo,
                                      Results& results);

/// Whether an albedo's totals follow from bounces at ρ = 1.
bool follows_from_bounces(const Wanted& wanted, const Albedo& albedo);

}  // namespace heightlight
