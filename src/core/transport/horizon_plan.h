#pragma once

#include <memory>
#include <vector>

#include "heightlight/transport.h"
#include "transport/gather_calibration.h"
#include "transport/map_gather.h"
#include "transport/sky_calibration.h"
#include "visibility/horizon_sky.h"

namespace heightlight {

/// Shares of the error wanted that plans of the sky and of totals aim at: the calibration samples are small,
/// and miss part of the errors' tails.
constexpr double kSkyAim = 0.8;
constexpr double kTotalAim = 0.85;

/// Cost of a plan's walk of the sky: K (5 + ν) for K azimuths at ν samples per octave, less where receivers
/// walk every other azimuth. An azimuth took 4.3, 5.4, 7.1, 9.1 and 11.5 ns for ν of 8, 12, 16, 24 and 32.
double sky_cost(const SkyPlan& plan);

/// Chooses how the sky is to be walked.
SkyPlan plan_sky(SkyCalibration& calibration, const HorizonGoal& goal);

/// A radiosity / π that totals are planned for: at kPlanAlbedo, in units of the brightest direct irradiance,
/// by closed forms. Gathers of it err by about as much as gathers of the true radiosity.
struct PlanRadiosity {
  Map radiosity;
  std::vector<GatherCalibration::SeenField> seen;  ///< the radiosity as the calibration's receivers see it
  double per_sky = 1;                              ///< change of the direct irradiance per change of A
  double unevenness = 1;                           ///< as in GatherPlan
};

/// Finds the radiosities that a goal's totals are planned for; there is at least one.
std::vector<PlanRadiosity> plan_radiosities(const GatherCalibration& calibration, const Map& sky,
                                            const HorizonGoal& goal);

/// A sky that was walked, and the RMSE that the error of A brings into a total at kPlanAlbedo.
struct PlannedSky {
  SkyPlan plan = {};
  HorizonSky sky = {};
  std::vector<PlanRadiosity> radiosities = {};
  double effect = 0;  ///< that RMSE, for the radiosity for which it is largest
};

/// Plans and walks the sky. Where the error of A has one sign along a wall, it changes a total by more than
/// itself. Where it would take most of the total's error, the sky is walked once more, with less error in A
/// than the goal asks for.
PlannedSky find_sky_for_totals(const HeightPyramid& pyramid, const HorizonGoal& goal, const SkyWanted& wanted,
                               GatherCalibration& gathers, const Watch& watch);

/// How gathers are to be walked, and the object that walks them.
struct PlannedGather {
  GatherPlan plan = {};
  std::unique_ptr<MapGather> gather = {};
};

/// Plans the gathers once the sky is known; `error` is the RMSE wanted of a total.
PlannedGather plan_gather(const GatherCalibration& calibration, const HeightPyramid& pyramid, double error,
                          const PlannedSky& planned_sky);

}  // namespace heightlight
