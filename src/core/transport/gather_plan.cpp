#include <algorithm>
#include <array>
#include <cmath>

#include "base/texels.h"
#include "transport/horizon_plan.h"
#include "transport/progressive_gather.h"
#include "transport/seen_places.h"

namespace heightlight {
namespace {

/// Share of the error wanted of gathers that ending them may take.
constexpr double kEndShare = 0.35;

/// However much of the error aimed at the error of A takes, at least this share of it is left for gathers.
constexpr double kLeastShare = 0.4;

/// Where sampling leaves less than this share of the error wanted, finer samples are not tried.
constexpr double kFineEnough = 0.3;

/// The error of few azimuths is small if it is no more than this share of the error of sampling.
constexpr double kLittle = 0.5;

/// A finer walk that leaves more than this share of the coarser walk's error is not worth it.
constexpr double kWorthFiner = 0.9;

/// The noise of the radiosity that the last gather reads adds to the noise of the gather itself. It adds this
/// share of the error of a gather along the same number of azimuths: on bricks 0.5 to 0.7, where all
/// receivers along a joint see the same noise, on fractal ground half of that.
constexpr double kCarriedShare = 0.5;

/// Azimuths in the sums of a gather, each with its weight there, when `left` gathers are left, itself
/// included.
double azimuths_together(int left, int last_azimuths) {
  constexpr int kGathers = 5;
  double azimuths = 0;
  for (int k = left + kGathers; k >= left; --k)
    azimuths = kFading * azimuths + gather_azimuths(k, last_azimuths);
  return azimuths;
}

/// The error of a gather along few azimuths. It is measured for 2, 4, 8 and 16; between and beyond these it
/// falls as it does from 8 to 16.
class AzimuthErrors {
 public:
  AzimuthErrors(const GatherCalibration& calibration, const Map& x)
      : measured_(calibration.azimuth_errors(calibration.see_field(x))) {
    find_order();
  }

  /// Takes the largest error of all radiosities.
  AzimuthErrors(const GatherCalibration& calibration, const std::vector<PlanRadiosity>& radiosities) {
    for (const PlanRadiosity& radiosity : radiosities) {
      const GatherCalibration::AzimuthTrials found = calibration.azimuth_errors(radiosity.seen);
      for (std::size_t i = 0; i < found.size(); ++i) measured_[i] = std::max(measured_[i], found[i]);
    }
    find_order();
  }

  double at(double azimuths) const {
    const int i = std::clamp(static_cast<int>(std::log2(azimuths)) - 1, 0, 3);
    return measured_[static_cast<std::size_t>(i)] * std::pow(std::ldexp(2.0, i) / azimuths, order_);
  }

 private:
  void find_order() {
    if (measured_[3] > 0) order_ = std::clamp(std::log2(measured_[2] / measured_[3]), 0.5, 1.5);
  }

  GatherCalibration::AzimuthTrials measured_{};
  double order_ = 1;
};

/// Share of the error aimed at that few azimuths may take in the first of single bounces.
constexpr double kBounceShare = 0.7;

/// The fewest azimuths with which the first bounce, a gather of A, errs by no more than `error`.
int choose_bounce_azimuths(const AzimuthErrors& errors, double error) {
  constexpr int kMostAzimuths = 192;
  int azimuths = 4;
  while (azimuths < kMostAzimuths && errors.at(azimuths) > error) azimuths += 4;
  return azimuths;
}

/// Share of the error of the last gather's own azimuths that earlier gathers do not remove: azimuths turned
/// from gather to gather lie less evenly than as many azimuths of a single gather. This decides where few
/// azimuths suffice only because they are even, such as on ridges.
constexpr double kUnevenShare = 0.2;

/// The error that azimuths leave when each of the last gathers walks `azimuths`.
double azimuths_leave(const AzimuthErrors& errors, int azimuths) {
  return std::hypot(errors.at(azimuths_together(1, azimuths)),
                    kCarriedShare * errors.at(azimuths_together(2, azimuths)),
                    kUnevenShare * errors.at(azimuths));
}

/// Cost of five gathers, a usual number. An azimuth took 24, 30, 34, 42, 49, 59 and 70 ns per texel for ν of
/// 8, 12, 16, 24, 32, 48 and 64 on bricks, and a gather without azimuths 15.
double gathers_cost(int samples_per_octave, int azimuths) {
  constexpr int kGathers = 5;
  double walked = 0;
  for (int left = 1; left <= kGathers; ++left) walked += gather_azimuths(left, azimuths);
  return kGathers * 15 + walked * (17 + 0.85 * samples_per_octave);
}

/// A plan with its samples per octave, azimuths and error, and its cost.
struct Candidate {
  GatherPlan plan = {};
  double cost = 0;
};

/// The most azimuths to try. Under the sky more azimuths add little; with a sun, which lights one side of a
/// roof and not the other, they add much.
constexpr int most_azimuths(double unevenness) { return unevenness > 1 ? 256 : 64; }

/// Chooses the fewest azimuths that, together with the error of sampling, leave no more than the error
/// wanted. If there are none, chooses so many that their error is small beside that of sampling.
Candidate choose_azimuths(const AzimuthErrors& errors, double sampled, double wanted, GatherPlan plan) {
  for (const int azimuths : {2, 4, 8, 12, 16, 20, 24, 32, 40, 48, 64, 96, 128, 192, 256}) {
    if (azimuths > most_azimuths(plan.unevenness)) break;
    plan.walk.azimuths = azimuths;
    const double few = azimuths_leave(errors, azimuths);
    plan.error = std::hypot(sampled, few, kEndShare * wanted);
    if (plan.error <= wanted || (sampled > wanted && few < kLittle * sampled)) break;
  }
  return {plan, gathers_cost(plan.walk.samples_per_octave, plan.walk.azimuths)};
}

bool is_better(const Candidate& a, const Candidate& b, double wanted) {
  const bool meets = a.plan.error <= wanted;
  if (meets != (b.plan.error <= wanted)) return meets;
  return meets ? a.cost < b.cost : a.plan.error < kWorthFiner * b.plan.error;
}

/// The part of a total's error that is left for gathers beside what A brings, `by_sky`.
double error_for_gathers(double error, double by_sky) {
  const double aim = kTotalAim * error;
  return std::sqrt(std::max(aim * aim - by_sky * by_sky, kLeastShare * aim * (kLeastShare * aim)));
}

/// Radiosity / π at kPlanAlbedo; `irradiance(i)` is E/π of texel i.
template <class Irradiance>
Map radiosity_of(const Map& sky, Irradiance&& irradiance) {
  Map radiosity(sky.width, sky.height);
  for_texels(sky, [&](std::size_t i) {
    radiosity.values[i] =
        std::isnan(sky.values[i]) ? sky.values[i] : static_cast<float>(kPlanAlbedo * irradiance(i));
  });
  return radiosity;
}

/// Radiosity of a user-given light. The closed form knows under the sky what bounces bring, G − A. For the
/// light this is scaled by the ratio of the two mean direct irradiances of what is seen.
PlanRadiosity plan_radiosity(const Surface& surface, const Map& sky, const TexelVector& direct) {
  const double brightest = *std::max_element(direct.begin(), direct.end());
  const double per_unit = brightest > 0 ? 1 / brightest : 0;
  double seen_direct = 0;
  double seen_sky = 0;
  for_seen_places(sky, surface, [&](std::size_t i, double share, double area) {
    seen_direct += share * area * direct[i] * per_unit;
    seen_sky += share * area * double{sky.values[i]};
  });
  const double per_bounced = seen_sky > 0 ? seen_direct / seen_sky : 0;
  return {.radiosity = radiosity_of(sky,
                                    [&](std::size_t i) {
                                      const auto share = double{sky.values[i]};
                                      const double bounced = guess_total(share, kPlanAlbedo) - share;
                                      return direct[i] * per_unit + per_bounced * bounced;
                                    }),
          .seen = {},
          .per_sky = 0,
          .unevenness = unevenness({.direct = &direct, .albedo = kPlanAlbedo}, sky, surface)};
}

/// RMSE that sampling brings into a total, for the radiosity for which it is largest.
double sampling_error(const GatherCalibration& calibration, const MapGather& gather,
                      const std::vector<PlanRadiosity>& radiosities) {
  double largest = 0;
  for (const PlanRadiosity& radiosity : radiosities) {
    FieldPyramid pyramid = gather.make_pyramid();
    pyramid.fill(radiosity.radiosity);
    largest = std::max(largest, calibration.sampling_error(gather, pyramid, radiosity.seen));
  }
  return largest;
}

}  // namespace

std::vector<PlanRadiosity> plan_radiosities(const GatherCalibration& calibration, const Map& sky,
                                            const HorizonGoal& goal) {
  std::vector<PlanRadiosity> radiosities;
  for (const TexelVector& direct : goal.direct)
    radiosities.push_back(plan_radiosity(calibration.surface(), sky, direct));
  if (radiosities.empty()) {
    const auto total = [&](std::size_t i) { return guess_total(double{sky.values[i]}, kPlanAlbedo); };
    radiosities.push_back({.radiosity = radiosity_of(sky, total), .seen = {}});
  }
  for (PlanRadiosity& radiosity : radiosities) radiosity.seen = calibration.see_field(radiosity.radiosity);
  return radiosities;
}

PlannedGather plan_gather(const GatherCalibration& calibration, const HeightPyramid& pyramid, double error,
                          const PlannedSky& planned_sky) {
  PlannedGather planned;
  planned.plan.walk.peak_share = planned_sky.plan.walk.peak_share;
  planned.plan.walk.samples_per_octave = 16;
  if (calibration.empty()) {
    planned.gather = std::make_unique<MapGather>(calibration.surface(), pyramid, planned.plan.walk);
    return planned;
  }
  const Map& sky = planned_sky.sky.sky_view_factor;
  const std::vector<PlanRadiosity>& radiosities = planned_sky.radiosities;
  const AzimuthErrors errors(calibration, radiosities);
  planned.plan.unevenness = 0;
  for (const PlanRadiosity& radiosity : radiosities)
    planned.plan.unevenness = std::max(planned.plan.unevenness, radiosity.unevenness);
  const double wanted = error_for_gathers(error, planned_sky.effect);
  Candidate best;
  for (const int samples_per_octave : {8, 12, 16, 24, 32, 48, 64}) {
    GatherPlan plan = planned.plan;
    plan.walk.samples_per_octave = samples_per_octave;
    auto gather = std::make_unique<MapGather>(calibration.surface(), pyramid, plan.walk);
    const double sampled = sampling_error(calibration, *gather, radiosities);
    const Candidate candidate = choose_azimuths(errors, sampled, wanted, plan);
    if (!planned.gather || is_better(candidate, best, wanted)) {
      best = candidate;
      planned.gather = std::move(gather);
    }
    if (sampled <= kFineEnough * wanted) break;
  }
  planned.plan = best.plan;
  planned.plan.first_bounce_azimuths =
      choose_bounce_azimuths({calibration, sky}, kBounceShare * kTotalAim * error);
  return planned;
}

}  // namespace heightlight
