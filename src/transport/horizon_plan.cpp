#include "transport/horizon_plan.h"

#include <array>
#include <cmath>
#include <limits>

namespace heightlight {
namespace {

/// Share of the error wanted that sampling may take in the sky, and links may take in the total.
constexpr double kSamplingShare = 0.75;
constexpr double kLinkShare = 0.7;

/// An error of what one gather of the direct light brings becomes one of the total at ρ = 0.8 that is
/// smaller: the total is the more even field. Measured 0.4 (smooth) to 0.7 (steep bricks).
constexpr double kTotalPerGather = 0.75;

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
  for (const int azimuths : {8, 12, 16, 20, 24, 32, 40, 48, 64, 80, 96, 128, 160, 192}) {
    options.azimuths = azimuths;
    reached = pilot.azimuth_error(options);
    if (reached <= error) break;
  }
  return options;
}

WalkOptions choose_links(HorizonPilot& pilot, const LightMips& light, const TexelVector& direct,
                         float peak_share, double error, double& reached) {
  WalkOptions best;
  reached = std::numeric_limits<double>::infinity();
  constexpr std::array<std::array<int, 2>, 10> kLadder{
      {{8, 8}, {8, 16}, {12, 16}, {16, 16}, {12, 32}, {16, 32}, {24, 32}, {32, 32}, {48, 32}, {48, 64}}};
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

HorizonPlan plan_sky(HorizonPilot& pilot, double error, int azimuths) {
  HorizonPlan plan;
  if (azimuths > 0) plan.sky.azimuths = azimuths;
  if (pilot.empty()) return plan;
  double sampling = 0;
  double few = 0;
  plan.sky = choose_sampling(pilot, error, sampling);
  if (azimuths > 0) {
    plan.sky.azimuths = azimuths;
    few = pilot.azimuth_error(plan.sky);
  } else {
    const double rest = std::sqrt(std::max(error * error - sampling * sampling, 0.25 * error * error));
    plan.sky = choose_azimuths(pilot, plan.sky, rest, few);
  }
  plan.sky_error = std::hypot(sampling, few);
  return plan;
}

void plan_links(HorizonPilot& pilot, const LightMips& light, const TexelVector& direct, double error,
                HorizonPlan& plan) {
  if (pilot.empty()) return;
  plan.links = choose_links(pilot, light, direct, plan.sky.peak_share, error, plan.link_error);
}

}  // namespace heightlight
