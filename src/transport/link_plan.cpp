#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "transport/horizon_plan.h"
#include "transport/receiver_blocks.h"

namespace heightlight {
namespace {

/// Share of the error aimed at that links may take, in the total at kPlanAlbedo.
constexpr double kLinkShare = 0.9;

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

/// Share of the links' error that a lattice may leave where receivers have no links of their own. On brick at
/// 1024², for .004 in all, shares of .75/.5/.37 leave 46/54/61 % of the receivers with their own.
constexpr double kSpreadShare = 0.5;

/// Halving a lattice's stride left .45 to .66 of its error, on brick and Ground054, and .87 of the receivers
/// that need links of their own: lattices that are not to be hoped to cost less are not tried.
constexpr double kHopeful = 2;
constexpr double kOwnShareLeft = 0.8;

/// Radiosity / π at albedo kPlanAlbedo, were every receiver to see only its like: ρA / (1 − ρ(1 − A)). What
/// links make of it errs by about as much as what they make of the true one.
TexelVector guess_radiosity(const TexelVector& direct) {
  return (kPlanAlbedo * direct.array() / (1 - kPlanAlbedo * (1 - direct.array()))).matrix();
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

std::unique_ptr<SeenLight> plan_links(HorizonPilot& pilot, const HeightMips& mips, const TexelVector& direct,
                                      const HorizonGoal& goal, const HorizonOptions& options,
                                      HorizonPlan& plan) {
  std::unique_ptr<SeenLight> light;
  if (pilot.empty()) {
    plan.links.peak_share = plan.sky.peak_share;
  } else {
    const TexelVector radiosity = guess_radiosity(direct);
    const double wanted = kLinkShare * kPlanAim * goal.error;
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
