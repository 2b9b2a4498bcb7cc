#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "base/texels.h"
#include "heightlight/forms.h"
#include "transport/horizon_plan.h"

namespace heightlight {
namespace {

/// Share of the error aimed at that gathers may take, in the total at kPlanAlbedo.
constexpr double kGatherShare = 0.9;

/// Of that, the share that sampling may take: the rest is for few azimuths and for ending.
constexpr double kGatherSamplingShare = 0.7;
constexpr double kEndShare = 0.35;

/// A finer walk that leaves more than this of the error is not worth it.
constexpr double kWorthFiner = 0.9;

/// Radiosity / π at kPlanAlbedo, as the closed form has it. What gathers make of it errs by about as much as
/// what they make of the true one.
Map guess_radiosity(const Map& sky) {
  Map radiosity(sky.width, sky.height);
  constexpr auto kAlbedo = static_cast<float>(kPlanAlbedo);
  for_texels(sky, [&](std::size_t i) {
    const SkyViewFactor<float> share(sky.values[i]);
    const bool missing = std::isnan(sky.values[i]);
    radiosity.values[i] =
        missing ? sky.values[i] : kAlbedo * bounced_total(share, guess_seen(share), kAlbedo);
  });
  return radiosity;
}

/// The coarsest walk whose sampling leaves no more than the error; if none does, the best.
double choose_fineness(HorizonPilot& pilot, const HeightMips& mips, const Map& radiosity, double error,
                       PlannedGather& planned) {
  double best = std::numeric_limits<double>::infinity();
  for (const int fineness : {8, 12, 16, 24, 32, 48, 64}) {
    WalkOptions walk = planned.plan.walk;
    walk.fineness = fineness;
    auto gather = std::make_unique<MapGather>(pilot.surface(), mips, walk);
    FieldPyramid pyramid = gather->make_pyramid();
    pyramid.fill(radiosity);
    const double found = pilot.gather_sampling_error(*gather, pyramid, radiosity);
    if (!planned.gather || found < kWorthFiner * best) {
      planned.plan.walk = walk;
      planned.gather = std::move(gather);
      best = found;
    }
    if (found <= error) break;
  }
  return best;
}

/// What the noise of the light that the last gather sees adds to its own, as a share of what one gather of as
/// many azimuths leaves: on bricks at 128² and 1024² 0.5 to 0.7. Along a joint all receivers see it alike.
constexpr double kCarriedShare = 0.6;

/// What a gather of few azimuths leaves: measured for 2, 4, 8 and 16, between them and beyond as from 8
/// to 16.
class AzimuthErrors {
 public:
  AzimuthErrors(const HorizonPilot& pilot, const Map& radiosity) {
    for (std::size_t i = 0; i < measured_.size(); ++i)
      measured_[i] = pilot.gather_azimuth_error(2 << static_cast<int>(i), radiosity);
    if (measured_[3] > 0) order_ = std::clamp(std::log2(measured_[2] / measured_[3]), 0.5, 1.5);
  }

  double at(int azimuths) const {
    const int i = std::clamp(static_cast<int>(std::bit_width(static_cast<unsigned>(azimuths))) - 2, 0, 3);
    return measured_[static_cast<std::size_t>(i)] * std::pow(std::ldexp(2.0, i) / azimuths, order_);
  }

 private:
  std::array<double, 4> measured_{};
  double order_ = 1;
};

/// What K azimuths in each of the last two gathers leave, whose sums are taken together, for the fewest K
/// that leave no more than the error.
double choose_azimuths(const HorizonPilot& pilot, const Map& radiosity, double error, GatherPlan& plan) {
  const AzimuthErrors errors(pilot, radiosity);
  double left = 0;
  for (const int azimuths : {2, 4, 6, 8, 12, 16, 24, 32, 48, 64}) {
    left = std::hypot(errors.at(2 * azimuths), kCarriedShare * errors.at(azimuths));
    plan.walk.azimuths = azimuths;
    if (left <= error) break;
  }
  return left;
}

}  // namespace

PlannedGather plan_gather(HorizonPilot& pilot, const HeightMips& mips, const Map& sky,
                          const HorizonGoal& goal, const SkyPlan& sky_plan) {
  PlannedGather planned;
  planned.plan.walk.peak_share = sky_plan.walk.peak_share;
  planned.plan.walk.fineness = 16;
  if (pilot.empty()) {
    planned.gather = std::make_unique<MapGather>(pilot.surface(), mips, planned.plan.walk);
    return planned;
  }
  const Map radiosity = guess_radiosity(sky);
  const double wanted = kGatherShare * kPlanAim * goal.error;
  const double sampled = choose_fineness(pilot, mips, radiosity, kGatherSamplingShare * wanted, planned);
  const double end = kEndShare * wanted;
  const double rest =
      std::sqrt(std::max(wanted * wanted - sampled * sampled - end * end, 0.25 * wanted * wanted));
  const double few = choose_azimuths(pilot, radiosity, rest, planned.plan);
  planned.plan.error = std::hypot(sampled, few, end);
  return planned;
}

}  // namespace heightlight
