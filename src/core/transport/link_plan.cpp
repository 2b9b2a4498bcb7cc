#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/texel_algebra.h"
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
  const auto sky = as_eigen(direct).array();
  return to_texels((kPlanAlbedo * sky / (1 - kPlanAlbedo * (1 - sky))).matrix());
}

/// What all trials share.
struct LinkSearch {
  HorizonPilot& pilot;
  const TexelVector& radiosity;  ///< what is gathered to judge links
  const TexelVector& sky;        ///< the receivers' shares
  double wanted = 0;             ///< RMSE of the total that links may leave
  float peak_share = 0;          ///< as the sky's walk has it
  const LinkLimits& limits;
};

/// Links of a lattice of receivers, how far they will do, and what walking them and own links beside them
/// costs, in units of own links for all.
struct LatticeTrial {
  std::unique_ptr<SeenLight> light = {};
  LinkPlan plan;
  std::vector<double> errors = {};  ///< of the pilot's receivers, in a gather by the lattice alone
  double cost = 1;
};

LatticeTrial try_lattice(const LinkSearch& search, int stride) {
  const HorizonPilot& pilot = search.pilot;
  const TexelVector& radiosity = search.radiosity;
  const TexelVector& sky = search.sky;
  const double wanted = search.wanted;
  const Surface& surface = pilot.surface();
  const WalkOptions walk{.azimuths = 12, .fineness = 8, .peak_share = search.peak_share};
  LatticeTrial trial{.plan = {.walk = walk, .lattice_stride = stride, .lattice_walk = walk}};
  trial.light = std::make_unique<SeenLight>(surface, trial.plan, search.limits);
  TexelVector gathered(radiosity.size());
  trial.light->gather(radiosity, sky, gathered);
  trial.errors = pilot.gather_errors(radiosity, gathered, sky);
  trial.plan.error = root_mean_square(trial.errors);
  trial.plan.own_share = 0;
  if (trial.plan.error > wanted) {
    const double from = pilot.find_harmless(trial.errors, sky, kSpreadShare * wanted).below;
    trial.plan.own_share = block_share(surface, blocks_above(surface, sky, from));
  }
  trial.cost = trial.plan.own_share + 1.0 / (stride * stride);
  return trial;
}

/// The lattice that costs least, if any costs less than own links for all.
LatticeTrial choose_lattice(const LinkSearch& search) {
  LatticeTrial best;
  double own = 0;  // the share with own links to be hoped for beside the next
  for (const int stride : {8, 4, 2}) {
    if (!ReceiverLattice::fits(search.pilot.surface(), stride)) continue;
    if (own + 1.0 / (stride * stride) >= best.cost) break;
    LatticeTrial trial = try_lattice(search, stride);
    own = trial.plan.error < kHopeful * search.wanted ? 0 : kOwnShareLeft * trial.plan.own_share;
    if (trial.cost < best.cost) best = std::move(trial);
  }
  return best;
}

/// Own links, and which receivers are to have them beside a lattice: what costs least of what leaves no more
/// than the error wanted. If nothing does, the best links, for all.
void choose_own_links(const LinkSearch& search, const LatticeTrial& lattice, LinkPlan& plan) {
  const Surface& surface = search.pilot.surface();
  const double wanted = search.wanted;
  LightMips light(surface);
  light.fill(search.radiosity);
  const auto harmless = [&](double error) {
    return lattice.light ? search.pilot.find_harmless(lattice.errors, search.sky, error)
                         : HorizonPilot::Harmless{.below = 0, .left = 0};
  };
  const auto share_from = [&](double least) {
    return block_share(surface, blocks_above(surface, search.sky, least));
  };
  const double fewest = share_from(harmless(wanted).below);
  double least = std::numeric_limits<double>::infinity();
  plan.own_from = 0;
  plan.own_share = 1;
  plan.error = least;
  for (const auto& [azimuths, fineness] : kLinkLadder) {
    const WalkOptions walk{.azimuths = azimuths, .fineness = fineness, .peak_share = search.peak_share};
    const double cost = azimuths * (13.0 + fineness);
    if (fewest * cost >= least) break;
    const double links = search.pilot.link_error(walk, light, search.radiosity);
    if (links > wanted) {
      if (links < plan.error) {
        plan.walk = walk;
        plan.error = links;
      }
      continue;
    }
    const auto [below, left] = harmless(std::sqrt(wanted * wanted - links * links));
    const double share = share_from(below);
    if (share * cost >= least) continue;
    least = share * cost;
    plan.walk = walk;
    plan.own_from = below;
    plan.own_share = share;
    plan.error = std::hypot(links, left);
  }
}

}  // namespace

std::unique_ptr<SeenLight> plan_links(HorizonPilot& pilot, const HeightMips& mips, const TexelVector& direct,
                                      const HorizonGoal& goal, const LinkLimits& limits, HorizonPlan& plan) {
  std::unique_ptr<SeenLight> light;
  LinkPlan& links = plan.links;
  if (pilot.empty()) {
    links.walk.peak_share = plan.sky.walk.peak_share;
  } else {
    const TexelVector radiosity = guess_radiosity(direct);
    const LinkSearch search{.pilot = pilot,
                            .radiosity = radiosity,
                            .sky = direct,
                            .wanted = kLinkShare * kPlanAim * goal.error,
                            .peak_share = plan.sky.walk.peak_share,
                            .limits = limits};
    LatticeTrial lattice = choose_lattice(search);
    links = lattice.plan;
    if (links.own_share > 0) choose_own_links(search, lattice, links);
    light = std::move(lattice.light);
  }
  if (links.own_share == 1) links.lattice_stride = 1;
  if (links.lattice_stride == 1) light = std::make_unique<SeenLight>(pilot.surface(), links, limits);
  if (links.own_share > 0) light->add_own_links(mips, direct, links, limits);
  return light;
}

}  // namespace heightlight
