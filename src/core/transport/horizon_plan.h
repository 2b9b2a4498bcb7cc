#pragma once

#include <memory>

#include "transport/horizon_pilot.h"
#include "transport/map_gather.h"

namespace heightlight {

/// Of the error wanted, what a plan aims at: the pilot's sample is small.
constexpr double kPlanAim = 0.9;

/// What a plan's walk of the sky costs, K (5 + ν), less where every other azimuth is walked: an azimuth took
/// 4.3, 5.4, 7.1, 9.1 and 11.5 ns for ν of 8, 12, 16, 24 and 32.
double sky_cost(const SkyPlan& plan);

/// How the sky is to be walked.
SkyPlan plan_sky(HorizonPilot& pilot, const HorizonGoal& goal);

/// How gathers are to be walked, and what walks them.
struct PlannedGather {
  GatherPlan plan = {};
  std::unique_ptr<MapGather> gather = {};
};

/// Once the sky is known: `sky` is A per texel, found as `sky_plan` has it.
PlannedGather plan_gather(HorizonPilot& pilot, const HeightMips& mips, const Map& sky,
                          const HorizonGoal& goal, const SkyPlan& sky_plan);

}  // namespace heightlight
