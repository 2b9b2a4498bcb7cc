#pragma once

#include <memory>

#include "transport/horizon_pilot.h"
#include "transport/seen_light.h"

namespace heightlight {

/// Of the error wanted, what a plan aims at: the pilot's sample is small.
constexpr double kPlanAim = 0.9;

/// The albedo up to which a plan's error is meant.
constexpr double kPlanAlbedo = 0.8;

/// What a plan's walk of the sky costs, K (5 + ν), less where every other azimuth is walked: an azimuth took
/// 4.3, 5.4, 7.1, 9.1 and 11.5 ns for ν of 8, 12, 16, 24 and 32.
double sky_cost(const SkyPlan& plan);

/// How the sky is to be walked.
SkyPlan plan_sky(HorizonPilot& pilot, const HorizonGoal& goal);

/// The links' part, once the direct light is known, and the links themselves. Lattices of receivers are tried
/// first, the coarsest at first: they cost little. Where their error is harmless, for all receivers or for
/// those that see little of the surface, they are kept; the others get links of their own.
std::unique_ptr<SeenLight> plan_links(HorizonPilot& pilot, const HeightMips& mips, const TexelVector& direct,
                                      const HorizonGoal& goal, const LinkLimits& limits, HorizonPlan& plan);

}  // namespace heightlight
