#pragma once

#include <memory>
#include <vector>

#include "heightlight/transport.h"
#include "transport/gather_calibration.h"
#include "transport/map_gather.h"
#include "transport/sky_calibration.h"
#include "visibility/horizon_sky.h"

namespace heightlight {

/// Of the error wanted, what plans aim at: the calibration samples are small, and miss some of the tails.
constexpr double kSkyAim = 0.8;
constexpr double kTotalAim = 0.85;

/// What a plan's walk of the sky costs, K (5 + ν), less where every other azimuth is walked: an azimuth took
/// 4.3, 5.4, 7.1, 9.1 and 11.5 ns for ν of 8, 12, 16, 24 and 32.
double sky_cost(const SkyPlan& plan);

/// How the sky is to be walked.
SkyPlan plan_sky(SkyCalibration& calibration, const HorizonGoal& goal);

/// What totals are planned for: a radiosity / π at kPlanAlbedo, in units of the brightest direct
/// irradiance, as closed forms have it. What gathers make of it errs by about as much as what they make of
/// the true one.
struct PlanRadiosity {
  Map radiosity;
  std::vector<GatherCalibration::SeenField> seen;  ///< of the radiosity, by the calibration's receivers
  double per_sky = 1;                              ///< what direct irradiance changes by with A
  double unevenness = 1;                           ///< as GatherPlan has it
};

/// Those of a goal, at least one.
std::vector<PlanRadiosity> plan_radiosities(const GatherCalibration& calibration, const Map& sky,
                                            const HorizonGoal& goal);

/// A sky as it was walked, and the RMSE of a total at kPlanAlbedo that what A errs by brings.
struct PlannedSky {
  SkyPlan plan = {};
  HorizonSky sky = {};
  std::vector<PlanRadiosity> radiosities = {};
  double effect = 0;  ///< of the radiosity that it is largest for
};

/// A total hangs on A by more than A's own error, where that is of one sign along a wall. Where it would take
/// most of the total's error, A is walked once more, and better than it was wanted.
PlannedSky find_sky_for_totals(const HeightPyramid& pyramid, const HorizonGoal& goal, const SkyWanted& wanted,
                               GatherCalibration& gathers, const Watch& watch);

/// How gathers are to be walked, and what walks them.
struct PlannedGather {
  GatherPlan plan = {};
  std::unique_ptr<MapGather> gather = {};
};

/// Once the sky is known; `error` is the RMSE wanted of a total.
PlannedGather plan_gather(const GatherCalibration& calibration, const HeightPyramid& pyramid, double error,
                          const PlannedSky& planned_sky);

}  // namespace heightlight
