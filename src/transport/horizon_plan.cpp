#include "transport/horizon_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "transport/receiver_blocks.h"

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

/// Azimuths and fineness of links that are tried, by what walking them costs: about K (13 + ν). Walls want
/// fineness (brick at 1024²: 8/8 .0105, 12/12 .0046, 12/24 .0026, 24/16 .0031), what is smooth azimuths
/// (Ground054: .0022, .0010, .0009, .0005).
constexpr std::array<std::array<int, 2>, 13> kLinkLadder{{{8, 8},
                                                          {8, 12},
                                                          {8, 16},
                                                          {12, 12},
                                                          {12, 16},
                                                          {12, 20},
                                                          {12, 24},
                                                          {16, 24},
                                                          {24, 16},
                                                          {24, 24},
                                                          {24, 32},
                                                          {32, 32},
                                                          {48, 32}}};

/// Azimuths from which an error follows by K^(−3/2), as it does for horizons with jumps.
constexpr int kTriedAzimuths = 16;
constexpr double kAzimuthOrder = 1.5;
constexpr int kFewestAzimuths = 4;

/// Share of the links' error that a lattice may leave where receivers have no links of their own. On brick at
/// 1024², for .004 in all, shares of .75/.5/.37 leave 46/54/61 % of the receivers with their own.
constexpr double kSpreadShare = 0.5;

/// Halving a lattice's stride left .45 to .66 of its error, on brick and Ground054, and .87 of the receivers
/// that need links of their own: lattices that are not to be hoped to cost less are not tried.
constexpr double kHopeful = 2;
constexpr double kOwnShareLeft = 0.8;

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

/// Links of a lattice of receivers, how far they will do, and what walking them and own links beside them
/// costs, in units of own links for all.
struct LatticeTrial {
  std::unique_ptr<SeenLight> light;
  HorizonPlan plan;
  std::vector<double> errors;  ///< of the pilot's receivers, in a gather by the lattice alone
  double cost = 1;
};

LatticeTrial try_lattice(const HorizonPilot& pilot, int stride, const TexelVector& radiosity,
                         const TexelVector& sky, double wanted, const HorizonPlan& plan,
                         const HorizonOptions& options) {
  const Surface& surface = pilot.surface();
  LatticeTrial trial{nullptr, plan, {}};
  trial.plan.lattice_stride = stride;
  trial.plan.links = trial.plan.lattice_links = {12, 8, plan.sky.peak_share};
  trial.light = std::make_unique<SeenLight>(surface, trial.plan, options);
  TexelVector gathered(radiosity.size());
  trial.light->gather(radiosity, sky, gathered);
  trial.errors = pilot.gather_errors(radiosity, gathered, sky);
  trial.plan.link_error = root_mean_square(trial.errors);
  trial.plan.own_share = 0;
  if (trial.plan.link_error > wanted) {
    const double from = pilot.find_harmless(trial.errors, sky, kSpreadShare * wanted).below;
    trial.plan.own_share = block_share(surface, blocks_above(surface, sky, from));
  }
  trial.cost = trial.plan.own_share + 1.0 / (stride * stride);
  return trial;
}

/// The lattice that costs least, if any costs less than own links for all.
LatticeTrial choose_lattice(const HorizonPilot& pilot, const TexelVector& radiosity, const TexelVector& sky,
                            double wanted, const HorizonPlan& plan, const HorizonOptions& options) {
  LatticeTrial best{nullptr, plan, {}};
  double own = 0;  // the share with own links to be hoped for beside the next
  for (const int stride : {8, 4, 2}) {
    if (!ReceiverLattice::fits(pilot.surface(), stride)) continue;
    if (own + 1.0 / (stride * stride) >= best.cost) break;
    LatticeTrial trial = try_lattice(pilot, stride, radiosity, sky, wanted, plan, options);
    own = trial.plan.link_error < kHopeful * wanted ? 0 : kOwnShareLeft * trial.plan.own_share;
    if (trial.cost < best.cost) best = std::move(trial);
  }
  return best;
}

/// Own links, and which receivers are to have them beside a lattice: what costs least of what leaves no more
/// than the error wanted. If nothing does, the best links, for all.
void choose_own_links(HorizonPilot& pilot, const LatticeTrial& lattice, const TexelVector& radiosity,
                      const TexelVector& sky, double wanted, HorizonPlan& plan) {
  const Surface& surface = pilot.surface();
  LightMips light(surface);
  light.fill(radiosity);
  const auto harmless = [&](double error) {
    return lattice.light ? pilot.find_harmless(lattice.errors, sky, error) : HorizonPilot::Harmless{0, 0};
  };
  const auto share_from = [&](double least) {
    return block_share(surface, blocks_above(surface, sky, least));
  };
  const double fewest = share_from(harmless(wanted).below);
  double least = std::numeric_limits<double>::infinity();
  plan.own_links_from = 0;
  plan.own_share = 1;
  plan.link_error = least;
  for (const auto& [azimuths, fineness] : kLinkLadder) {
    const WalkOptions walk{azimuths, fineness, plan.sky.peak_share};
    const double cost = azimuths * (13.0 + fineness);
    if (fewest * cost >= least) break;
    const double links = pilot.link_error(walk, light, radiosity);
    if (links > wanted) {
      if (links < plan.link_error) {
        plan.links = walk;
        plan.link_error = links;
      }
      continue;
    }
    const auto [below, left] = harmless(std::sqrt(wanted * wanted - links * links));
    const double share = share_from(below);
    if (share * cost >= least) continue;
    least = share * cost;
    plan.links = walk;
    plan.own_links_from = below;
    plan.own_share = share;
    plan.link_error = std::hypot(links, left);
  }
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
  std::unique_ptr<SeenLight> light;
  if (pilot.empty()) {
    plan.links.peak_share = plan.sky.peak_share;
  } else {
    const TexelVector radiosity = guess_radiosity(direct);
    const double wanted = kLinkShare * kAim * goal.error;
    LatticeTrial lattice = choose_lattice(pilot, radiosity, direct, wanted, plan, options);
    plan = lattice.plan;
    if (plan.own_share > 0) choose_own_links(pilot, lattice, radiosity, direct, wanted, plan);
    light = std::move(lattice.light);
  }
  if (plan.own_share == 1) plan.lattice_stride = 1;
  if (plan.lattice_stride == 1) light = std::make_unique<SeenLight>(pilot.surface(), plan, options);
  if (plan.own_share > 0) light->add_own_links(mips, direct, plan, options);
  return light;
}

}  // namespace heightlight
