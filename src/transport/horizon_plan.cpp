#include "transport/horizon_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace heightlight {
namespace {

/// Of the error wanted, what a plan aims at: the pilot's sample is small.
constexpr double kAim = 0.9;

/// Share of the error aimed at that sampling may take in the sky, and links may take in the total, at
/// kAlbedo.
constexpr double kSamplingShare = 0.9;
constexpr double kLinkShare = 0.9;
constexpr double kAlbedo = 0.8;

/// Where the total alone is wanted: the share of its error that the sky may take. Links cost more.
constexpr double kSkyShare = 0.43;

/// Azimuths from which an error follows by K^(−3/2), as it does for horizons with jumps.
constexpr int kTriedAzimuths = 16;
constexpr double kAzimuthOrder = 1.5;
constexpr int kFewestAzimuths = 4;

/// Lattices whose error, grown with their stride from a coarser one's, would be this many times what is
/// wanted are not tried. It grows a little less: halving the stride left .45 to .66 of it on brick and
/// Ground054.
constexpr double kHopeless = 1.3;

/// Shares of the peaks tried: from 0 to this.
constexpr float kPeakShareStep = 0.15F;
constexpr float kHighestPeakShare = 0.75F;

double azimuth_cost(int fineness) { return walk_cost({1, fineness}); }

/// The walk that should reach the error at the least cost, as far as its sampling goes: what that leaves of
/// the error, azimuths must fill. Where no sampling is good enough, the best.
WalkOptions choose_sampling(HorizonPilot& pilot, double error, int azimuths, double& reached) {
  const double tried = pilot.azimuth_error({kTriedAzimuths, 8, 0.3F});
  const auto azimuths_for = [&](double rest) {
    return azimuths > 0 ? azimuths : kTriedAzimuths * std::pow(tried / rest, 1 / kAzimuthOrder);
  };
  WalkOptions best;
  WalkOptions best_sampled;
  double least = std::numeric_limits<double>::infinity();
  double least_sampling = least;
  float share = 0;  // the best so far: finer walks want the same, or more
  for (const int fineness : {8, 12, 16, 20, 24, 32, 48, 64, 96, 128}) {
    // A finer walk that had no sampling error at all would not pay any more.
    if (azimuths_for(error) * azimuth_cost(fineness) >= least) break;
    double sampling = pilot.sampling_error(fineness, share);
    while (share < kHighestPeakShare) {
      const float more = share + kPeakShareStep;
      const double found = pilot.sampling_error(fineness, more);
      if (found >= sampling) break;
      sampling = found;
      share = more;
    }
    if (sampling < least_sampling) best_sampled = {2, fineness, share};
    least_sampling = std::min(least_sampling, sampling);
    if (sampling > kSamplingShare * error) continue;
    const double cost = azimuths_for(std::sqrt(error * error - sampling * sampling)) * azimuth_cost(fineness);
    if (cost >= least) break;
    least = cost;
    reached = sampling;
    best = {2, fineness, share};
  }
  if (std::isfinite(least)) return best;
  reached = least_sampling;
  return best_sampled;
}

/// The fewest azimuths that leave no more than the error, in steps of a tenth from the number that a few
/// tell, upwards or downwards.
WalkOptions choose_azimuths(HorizonPilot& pilot, WalkOptions options, double error, double& reached) {
  options.azimuths = kTriedAzimuths;
  const double tried = pilot.azimuth_error(options);
  const double guess = kTriedAzimuths * std::pow(tried / error, 1 / kAzimuthOrder);
  options.azimuths =
      std::clamp(static_cast<int>(guess) / 2 * 2, kFewestAzimuths, HorizonPilot::kManyAzimuths);
  reached = pilot.azimuth_error(options);
  const auto step = [](int azimuths) { return std::max(2, azimuths / 20 * 2); };
  while (reached > error && options.azimuths < HorizonPilot::kManyAzimuths) {
    options.azimuths += step(options.azimuths);
    reached = pilot.azimuth_error(options);
    if (reached <= error) return options;
  }
  while (reached <= error && options.azimuths > kFewestAzimuths) {
    WalkOptions fewer = options;
    fewer.azimuths -= step(options.azimuths);
    const double found = pilot.azimuth_error(fewer);
    if (found > error) break;
    options = fewer;
    reached = found;
  }
  return options;
}

/// Radiosity / π at albedo kAlbedo, were every receiver to see only its like: ρA / (1 − ρ(1 − A)). What links
/// make of it errs by about as much as what they make of the true one.
TexelVector guess_radiosity(const TexelVector& direct) {
  return (kAlbedo * direct.array() / (1 - kAlbedo * (1 - direct.array()))).matrix();
}

/// The cheapest links of all receivers that are good enough, else the best.
WalkOptions choose_links(HorizonPilot& pilot, const LightMips& light, const TexelVector& radiosity,
                         float peak_share, double error, double& reached) {
  WalkOptions best;
  reached = std::numeric_limits<double>::infinity();
  constexpr std::array<std::array<int, 2>, 11> kLadder{{{8, 8},
                                                        {8, 12},
                                                        {8, 16},
                                                        {12, 16},
                                                        {16, 16},
                                                        {24, 16},
                                                        {16, 24},
                                                        {24, 24},
                                                        {24, 32},
                                                        {32, 32},
                                                        {48, 32}}};
  for (const auto& [azimuths, fineness] : kLadder) {
    const WalkOptions options{azimuths, fineness, peak_share};
    const double links = pilot.link_error(options, light, radiosity);
    if (links < reached) {
      reached = links;
      best = options;
    }
    if (reached <= error) break;
  }
  return best;
}

}  // namespace

double walk_cost(const WalkOptions& options) { return options.azimuths * (5.0 + options.fineness); }

HorizonPlan plan_sky(HorizonPilot& pilot, const HorizonGoal& goal) {
  HorizonPlan plan;
  if (goal.azimuths > 0) plan.sky.azimuths = goal.azimuths;
  if (pilot.empty()) return plan;
  // A receiver that sees less of the sky sees more of the surface: its total changes by 1 − ρ × (the mean of
  // the total seen) of what A does. The total needs no better sky than A itself would.
  const double error =
      kAim * goal.error * goal.sky_share *
      (goal.total_only ? std::max(1.0, kSkyShare / (1 - kAlbedo * pilot.total_seen(kAlbedo))) : 1);
  double sampling = 0;
  double few = 0;
  plan.sky = choose_sampling(pilot, error, goal.azimuths, sampling);
  if (goal.azimuths > 0) {
    plan.sky.azimuths = goal.azimuths;
    few = pilot.azimuth_error(plan.sky);
  } else {
    const double rest = std::sqrt(std::max(error * error - sampling * sampling, 0.25 * error * error));
    plan.sky = choose_azimuths(pilot, plan.sky, rest, few);
  }
  plan.sky_error = std::hypot(sampling, few);
  return plan;
}

std::unique_ptr<SeenLight> plan_links(HorizonPilot& pilot, const HeightMips& mips, const TexelVector& direct,
                                      const HorizonGoal& goal, const HorizonOptions& options,
                                      HorizonPlan& plan) {
  const Surface& surface = pilot.surface();
  plan.links.peak_share = plan.sky.peak_share;
  if (!pilot.empty()) {
    const TexelVector radiosity = guess_radiosity(direct);
    const double wanted = kLinkShare * kAim * goal.error;
    double growth = 0;  // of a lattice's error with its stride, from the coarser one
    for (const int stride : {8, 4, 2}) {
      if (!ReceiverLattice::fits(surface, stride) || growth * stride > kHopeless * wanted) continue;
      plan.link_stride = stride;
      plan.links = {12, 8, plan.sky.peak_share};
      auto light = std::make_unique<SeenLight>(surface, mips, plan, options);
      TexelVector gathered(direct.size());
      light->gather(radiosity, direct, gathered);
      plan.link_error = pilot.gather_error(radiosity, gathered, direct);
      if (plan.link_error <= wanted) return light;
      growth = plan.link_error / stride;
    }
    plan.link_stride = 1;
    LightMips light(surface);
    light.fill(radiosity);
    plan.links = choose_links(pilot, light, radiosity, plan.sky.peak_share, wanted, plan.link_error);
  }
  return std::make_unique<SeenLight>(surface, mips, plan, options);
}

}  // namespace heightlight
