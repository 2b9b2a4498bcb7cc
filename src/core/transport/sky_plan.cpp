#include <algorithm>
#include <cmath>
#include <limits>

#include "transport/horizon_plan.h"
#include "transport/progressive_gather.h"

namespace heightlight {
namespace {

/// Share of the error aimed at that sampling may take.
constexpr double kSamplingShare = 0.9;

/// Sparse azimuths are used only if they cost less than this share of the fewest uniform azimuths.
constexpr double kWorthSparse = 0.85;

/// Number of azimuths on trial. With K azimuths the error is then taken to fall as K^(−3/2), as it does for
/// horizons with jumps.
constexpr int kTriedAzimuths = 16;
constexpr double kAzimuthOrder = 1.5;
constexpr int kFewestAzimuths = 4;

/// Peak shares are tried from 0 to this, in these steps.
constexpr float kPeakShareStep = 0.15F;
constexpr float kHighestPeakShare = 0.75F;

double azimuth_cost(int samples_per_octave) { return 5.0 + samples_per_octave; }

/// The fewest azimuths that should leave no more than the error, if sampling errs by `sampling`, and the
/// error of few azimuths is `tried` at kTriedAzimuths and falls with kAzimuthOrder. More than kManyAzimuths
/// if no number up to there does.
int fewest_azimuths(const SamplingError& sampling, double tried, double error) {
  int azimuths = kFewestAzimuths;
  const auto leaves = [&] {
    const double few = tried * std::pow(double{kTriedAzimuths} / azimuths, kAzimuthOrder);
    return std::hypot(sampling.at(azimuths), few);
  };
  while (azimuths <= SkyCalibration::kManyAzimuths && leaves() > error) azimuths += 2;
  return azimuths;
}

/// Chooses the samples per octave and the peak share that should reach the error at the least cost; the most
/// accurate if none reaches it. `azimuths` > 0 fixes their number.
WalkOptions choose_sampling(SkyCalibration& calibration, double error, int azimuths, SamplingError& reached) {
  constexpr int kMany = SkyCalibration::kManyAzimuths;
  const double tried = calibration.azimuth_error({kTriedAzimuths, 8, 0.3F});
  WalkOptions best;
  double least = std::numeric_limits<double>::infinity();
  double least_sampling = least;
  float share = 0;  // best so far: finer walks need the same or a larger share
  for (const int samples_per_octave : {8, 12, 16, 20, 24, 32, 48, 64, 96, 128}) {
    // Even without any sampling error a finer walk would cost more.
    const int at_least = azimuths > 0 ? azimuths : fewest_azimuths({}, tried, error);
    if (at_least * azimuth_cost(samples_per_octave) >= least) break;
    SamplingError sampling = calibration.sampling_error(samples_per_octave, share);
    while (share < kHighestPeakShare) {
      const float more = share + kPeakShareStep;
      const SamplingError found = calibration.sampling_error(samples_per_octave, more);
      if (found.at(kMany) >= sampling.at(kMany)) break;
      sampling = found;
      share = more;
    }
    // The trial contains the part of the sampling error that each azimuth has for itself.
    const double own = sampling.own * sampling.own * (1.0 / kTriedAzimuths - 1.0 / kMany);
    const double quadrature = std::sqrt(std::max(tried * tried - own, 0.5 * tried * tried));
    const int wanted = azimuths > 0 ? azimuths : fewest_azimuths(sampling, quadrature, error);
    const bool good = (azimuths > 0 || wanted <= kMany) && sampling.at(wanted) <= kSamplingShare * error;
    const double cost = wanted * azimuth_cost(samples_per_octave);
    if (std::isfinite(least) && (!good || cost >= least)) break;
    if (!good && sampling.at(kMany) >= least_sampling) continue;
    if (good) least = cost;
    least_sampling = sampling.at(kMany);
    reached = sampling;
    best = {2, samples_per_octave, share};
  }
  return best;
}

/// The fewest azimuths that leave no more than the error. Starts from the number that a trial of few azimuths
/// suggests, and goes up or down in steps of a tenth.
WalkOptions choose_azimuths(SkyCalibration& calibration, WalkOptions options, double error, double& reached) {
  options.azimuths = kTriedAzimuths;
  const double tried = calibration.azimuth_error(options);
  const double guess = kTriedAzimuths * std::pow(tried / error, 1 / kAzimuthOrder);
  options.azimuths =
      std::clamp(static_cast<int>(std::min(guess, double{SkyCalibration::kManyAzimuths})) / 2 * 2,
                 kFewestAzimuths, SkyCalibration::kManyAzimuths);
  reached = calibration.azimuth_error(options);
  const auto step = [](int azimuths) { return std::max(2, azimuths / 20 * 2); };
  while (reached > error && options.azimuths < SkyCalibration::kManyAzimuths) {
    options.azimuths += step(options.azimuths);
    reached = calibration.azimuth_error(options);
    if (reached <= error) return options;
  }
  while (reached <= error && options.azimuths > kFewestAzimuths) {
    WalkOptions fewer = options;
    fewer.azimuths -= step(options.azimuths);
    const double found = calibration.azimuth_error(fewer);
    if (found > error) break;
    options = fewer;
    reached = found;
  }
  return options;
}

/// Tries up to 35 % more azimuths, of which open ground walks every other one, and takes them where that
/// saves much. The calibration's few strips say little about which blocks lie on which side of the threshold.
void choose_sparse(SkyCalibration& calibration, double error, SkyPlan& plan, double& reached) {
  double least = kWorthSparse * plan.walk.azimuths;
  const WalkOptions uniform = plan.walk;
  for (const double more : {1.0, 1.1, 1.2, 1.35}) {
    WalkOptions options = uniform;
    options.azimuths = static_cast<int>(std::ceil(more * uniform.azimuths / 4)) * 4;
    if (options.azimuths > SkyCalibration::kManyAzimuths) break;
    const SkyCalibration::Sparse sparse = calibration.find_sparse(options, error);
    const double cost = options.azimuths * (1 + sparse.full_share) / 2;
    if (sparse.error > error || cost >= least) continue;
    least = cost;
    reached = sparse.error;
    plan.walk = options;
    plan.full_from = sparse.full_from;
    plan.full_share = sparse.full_share;
  }
}

}  // namespace

double sky_cost(const SkyPlan& plan) {
  return plan.walk.azimuths * azimuth_cost(plan.walk.samples_per_octave) * (1 + plan.full_share) / 2;
}

SkyPlan plan_sky(SkyCalibration& calibration, const HorizonGoal& goal) {
  SkyPlan plan;
  if (goal.azimuths > 0) plan.walk.azimuths = goal.azimuths;
  if (calibration.empty()) return plan;
  const double error = kSkyAim * goal.error * goal.sky_share;
  SamplingError sampling;
  double few = 0;
  plan.walk = choose_sampling(calibration, error, goal.azimuths, sampling);
  const double sampled = sampling.at(SkyCalibration::kManyAzimuths);  // the further error of fewer azimuths
                                                                      // is part of azimuth_error
  if (goal.azimuths > 0) {
    plan.walk.azimuths = goal.azimuths;
    few = calibration.azimuth_error(plan.walk);
  } else {
    const double rest = std::sqrt(std::max(error * error - sampled * sampled, 0.25 * error * error));
    plan.walk = choose_azimuths(calibration, plan.walk, rest, few);
    // Goals with a smaller sky_share are for bent normals, which lose more accuracy by it than A does.
    if (goal.sky_share == 1) choose_sparse(calibration, rest, plan, few);
  }
  plan.error = std::hypot(sampled, few);
  plan.sampled = sampled;
  return plan;
}

PlannedSky find_sky_for_totals(const HeightPyramid& pyramid, const HorizonGoal& goal, const SkyWanted& wanted,
                               GatherCalibration& gathers, const Watch& watch) {
  constexpr double kMostOfTotal = 0.75;
  // Gathers pass on errors that neighbours share: on bricks and fractal ground totals changed by 0.9 to 1.6
  // times what the last step makes of the error of A, and most where sampling costs more than few azimuths
  // do.
  constexpr double kPassedOn = 1.2;
  constexpr double kLeastOfError = 0.35;
  const Surface& surface = gathers.surface();
  SkyCalibration calibration(surface, pyramid, {.seed = goal.seed, .watch = watch});
  PlannedSky planned;
  const auto find = [&](const HorizonGoal& aimed) {
    planned.plan = plan_sky(calibration, aimed);
    planned.sky = walk_horizon_sky(surface, pyramid, planned.plan, {.wanted = wanted}, watch);
    gathers.see_classes(planned.sky.sky_view_factor, kPlanAlbedo);
    planned.radiosities = plan_radiosities(gathers, planned.sky.sky_view_factor, goal);
    planned.effect = 0;
    for (const PlanRadiosity& radiosity : planned.radiosities) {
      const double effect =
          kPassedOn * gathers.sky_effect(radiosity.seen, radiosity.per_sky) * planned.plan.error;
      planned.effect = std::max(planned.effect, effect);
    }
  };
  find(goal);
  const double most = kMostOfTotal * kTotalAim * goal.error;
  if (planned.effect > most && goal.azimuths == 0) {
    HorizonGoal finer = goal;
    finer.error *= std::max(kLeastOfError, most / planned.effect);
    find(finer);
  }
  return planned;
}

}  // namespace heightlight
