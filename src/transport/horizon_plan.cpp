#include "transport/horizon_plan.h"

#include <array>
#include <cmath>
#include <limits>

namespace heightlight {
namespace {

/// Share of the error wanted that sampling may take in the sky, and links may take in the total.
constexpr double kSamplingShare = 0.75;
constexpr double kLinkShare = 0.9;

/// An error of what one gather of the direct light brings becomes one of the total at ρ = 0.8 that is
/// smaller: the total is the more even field. Measured 0.4 (smooth) to 0.7 (steep bricks).
constexpr double kTotalPerGather = 0.7;

/// Where the total alone is wanted: the share of its error that the sky may take, at albedo kAlbedo, what is
/// seen having a mean total of kTotalSeen at least (deep joints between bricks: 0.6; open ground: 0.9 and
/// more).
constexpr double kSkyShare = 0.7;
constexpr double kAlbedo = 0.8;
constexpr double kTotalSeen = 0.75;

/// The coarsest walk whose sampling is good enough, with the best share of peaks; else the best one.
WalkOptions choose_sampling(HorizonPilot& pilot, double error, double& reached) {
  WalkOptions best;
  reached = std::numeric_limits<double>::infinity();
  for (const int fineness : {8, 16, 32, 64, 128}) {
    for (const float peak_share : {0.0F, 0.3F, 0.6F}) {
      const double sampling = pilot.sampling_error(fineness, peak_share);
      if (sampling >= reached) continue;
      reached = sampling;
      best.fineness = fineness;
      best.peak_share = peak_share;
    }
    if (reached <= kSamplingShare * error) break;
  }
  return best;
}

WalkOptions choose_azimuths(HorizonPilot& pilot, WalkOptions options, double error, double& reached) {
  for (const int azimuths : {4, 6, 8, 12, 16, 20, 24, 32, 40, 48, 64, 80, 96, 128, 160, 192}) {
    options.azimuths = azimuths;
    reached = pilot.azimuth_error(options);
    if (reached <= error) break;
  }
  return options;
}

/// The cheapest links of all receivers that are good enough, else the best.
WalkOptions choose_links(HorizonPilot& pilot, const LightMips& light, const TexelVector& direct,
                         float peak_share, double error, double& reached) {
  WalkOptions best;
  reached = std::numeric_limits<double>::infinity();
  constexpr std::array<std::array<int, 2>, 9> kLadder{
      {{8, 8}, {8, 16}, {12, 16}, {16, 16}, {24, 16}, {16, 32}, {24, 32}, {32, 32}, {48, 32}}};
  for (const auto& [azimuths, fineness] : kLadder) {
    const WalkOptions options{azimuths, fineness, peak_share};
    const double links = kTotalPerGather * pilot.link_error(options, light, direct);
    if (links < reached) {
      reached = links;
      best = options;
    }
    if (reached <= kLinkShare * error) break;
  }
  return best;
}

}  // namespace

HorizonPlan plan_sky(HorizonPilot& pilot, const HorizonGoal& goal) {
  HorizonPlan plan;
  if (goal.azimuths > 0) plan.sky.azimuths = goal.azimuths;
  if (pilot.empty()) return plan;
  // The total changes by 1 − ρ × (the mean of the total seen) of what A does, which is about 1 − ρ.
  const double error = goal.total_only ? kSkyShare * goal.error / (1 - kAlbedo * kTotalSeen) : goal.error;
  double sampling = 0;
  double few = 0;
  plan.sky = choose_sampling(pilot, error, sampling);
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
    for (const int stride : {8, 4, 2}) {
      if (!ReceiverLattice::fits(surface, stride)) continue;
      plan.link_stride = stride;
      plan.links = {12, 8, plan.sky.peak_share};
      auto light = std::make_unique<SeenLight>(surface, mips, plan, options);
      TexelVector gathered(direct.size());
      light->gather(direct, direct, gathered);
      plan.link_error = kTotalPerGather * pilot.gather_error(direct, gathered, direct);
      if (plan.link_error <= kLinkShare * goal.error) return light;
    }
    plan.link_stride = 1;
    LightMips light(surface);
    light.fill(direct);
    plan.links = choose_links(pilot, light, direct, plan.sky.peak_share, goal.error, plan.link_error);
  }
  return std::make_unique<SeenLight>(surface, mips, plan, options);
}

}  // namespace heightlight
