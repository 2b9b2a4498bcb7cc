#include <algorithm>

#include "base/stopwatch.h"
#include "heightlight/forms.h"
#include "solve/solver.h"

namespace heightlight {
namespace {

/// Of one channel of what is wanted at an albedo. A channel that only one of the two has goes with all.
IrradianceSystem system_of(const Task& task, const Albedo& albedo, std::size_t channel) {
  IrradianceSystem system;
  if (!task.direct.empty()) system.direct = &task.direct[channel % task.direct.size()];
  const std::size_t own = channel % albedo.channels();
  if (albedo.varying.empty()) {
    system.albedo = albedo.constant[own];
  } else {
    system.varying = &albedo.varying[own];
  }
  return system;
}

/// One system per channel of the totals asked for, in their order, and one at kSeenAlbedo where `seen` says
/// so.
std::vector<IrradianceSystem> list_systems(const Task& task, bool seen) {
  const Wanted& wanted = task.request.wanted;
  std::vector<IrradianceSystem> systems;
  for (const Albedo& albedo : wanted.totals) {
    for (std::size_t c = 0; c < total_channels(wanted, albedo); ++c)
      systems.push_back(system_of(task, albedo, c));
  }
  if (seen) systems.push_back({.albedo = kSeenAlbedo});
  return systems;
}

/// Totals, balanced where the direct irradiance is one's own.
struct BalancedTotals : Totals {
  std::vector<double> found_imbalance;  ///< per system, before that
};

/// The sky's totals are left as they are: where all is 1 at ρ = 1, walks are scaled for that.
BalancedTotals solve_balanced(const Task& task, const Transport& transport,
                              const std::vector<IrradianceSystem>& systems) {
  constexpr double kShareOfError = 0.3;
  BalancedTotals solved{transport.solve(systems, task.request.watch), {}};
  for (std::size_t i = 0; i < systems.size(); ++i) {
    TexelVector& total = solved.irradiance[i];
    solved.found_imbalance.push_back(audit_energy(task.surface, transport, systems[i], total).imbalance);
    if (systems[i].direct)
      balance_energy(task.surface, transport, systems[i], kShareOfError * task.request.accuracy.error, total);
  }
  return solved;
}

/// By exact walks, all of them from the same receivers: of α and A too.
std::vector<HorizonCheck> check_totals(const Task& task, const Transport& transport,
                                       const std::vector<IrradianceSystem>& systems, const Totals& solved) {
  std::vector<CheckedTotal> totals;
  for (std::size_t i = 0; i < systems.size(); ++i) {
    totals.push_back({.total = solved.irradiance[i],
                      .albedo = systems[i].albedo,
                      .varying = systems[i].varying,
                      .direct = systems[i].direct});
  }
  const Accuracy& accuracy = task.request.accuracy;
  return check_by_exact_walks(task.surface, transport.direct, totals,
                              {.seed = accuracy.seed,
                               .error = accuracy.error,
                               .ambient_occlusion = &transport.ambient_occlusion,
                               .above_horizontal = lights_from_above(task.request.wanted),
                               .watch = task.request.watch});
}

/// Totals, and what they err by, per system.
struct Checked {
  BalancedTotals& totals;
  std::vector<HorizonCheck> checks;
};

/// Finds those of the totals once more whose numbers are given, for a share of the error wanted.
void find_again(const Task& task, const std::vector<IrradianceSystem>& systems,
                const std::vector<std::size_t>& which, double share, Checked& checked) {
  std::vector<IrradianceSystem> again;
  for (const std::size_t i : which) again.push_back(systems[i]);
  const PlannedTransport finer = find_operator(task, share * task.request.accuracy.error, {});
  BalancedTotals found = solve_balanced(task, *finer.transport, again);
  const std::vector<HorizonCheck> found_checks = check_totals(task, *finer.transport, again, found);
  for (std::size_t k = 0; k < which.size(); ++k) {
    checked.totals.irradiance[which[k]] = std::move(found.irradiance[k]);
    checked.totals.found_imbalance[which[k]] = found.found_imbalance[k];
    checked.checks[which[k]].total_rmse = found_checks[k].total_rmse;
    checked.checks[which[k]].total_standard_error = found_checks[k].total_standard_error;
  }
  checked.totals.gathers = std::max(checked.totals.gathers, found.gathers);
}

/// Where the check finds that the error wanted is missed, totals are found once more, for a smaller one:
/// smaller the more it is missed by, and where the albedo has a texture, of which plans know nothing;
/// whatever becomes of other totals. Whether any was.
bool refine_totals(const Task& task, const std::vector<IrradianceSystem>& systems, Checked& checked) {
  const double wanted = task.request.accuracy.error;
  std::vector<std::size_t> little;
  std::vector<std::size_t> much;
  for (std::size_t i = 0; i < systems.size(); ++i) {
    const HorizonCheck& check = checked.checks[i];
    if (!is_missed(check.total_rmse, wanted, check.total_standard_error)) continue;
    (check.total_rmse > kMissedByMuch * wanted || systems[i].varying ? much : little).push_back(i);
  }
  if (!little.empty()) find_again(task, systems, little, kFiner, checked);
  if (!much.empty()) find_again(task, systems, much, kMuchFiner, checked);
  return !little.empty() || !much.empty();
}

/// The channel of each albedo that errs most stands for it.
void keep_worst_channels(const Wanted& wanted, const std::vector<HorizonCheck>& checks, Evidence& evidence) {
  auto next = checks.begin();
  for (const Albedo& albedo : wanted.totals) {
    const auto end = next + static_cast<std::ptrdiff_t>(total_channels(wanted, albedo));
    evidence.total_checks.push_back(*std::max_element(
        next, end, [](const HorizonCheck& a, const HorizonCheck& b) { return a.total_rmse < b.total_rmse; }));
    next = end;
  }
}

/// Of all that the request wants; the last of `solved` may be at kSeenAlbedo, which is nobody's to judge.
void check_and_refine(const Task& task, const Transport& transport, std::vector<IrradianceSystem> systems,
                      BalancedTotals& solved, Evidence& evidence) {
  const Request& request = task.request;
  std::size_t wanted = 0;
  for (const Albedo& albedo : request.wanted.totals) wanted += total_channels(request.wanted, albedo);
  systems.resize(wanted);
  Checked checked{.totals = solved, .checks = check_totals(task, transport, systems, solved)};
  if (checked.checks[0].receivers == 0) return;
  const Surface& surface = task.surface;
  const bool may_refine =
      request.accuracy.visibility == Visibility::horizon_walks && !request.accuracy.plan &&
      refinement_bytes(surface.width(), surface.height(), request.wanted) <= task.free_memory;
  evidence.refined = may_refine && refine_totals(task, systems, checked);
  evidence.sky_rmse = checked.checks[0].sky_rmse;
  keep_worst_channels(request.wanted, checked.checks, evidence);
}

}  // namespace

void note_solver(double residual, int iterations, Evidence& evidence) {
  // A residual that is none (NaN) stays.
  if (std::isnan(residual) || residual > evidence.solver_residual) evidence.solver_residual = residual;
  evidence.solver_iterations = std::max(evidence.solver_iterations, iterations);
}

TexelVector find_totals(const Task& task, const Transport& transport, Results& results) {
  const Request& request = task.request;
  const Wanted& wanted = request.wanted;
  Evidence& evidence = results.evidence;
  const bool seen = wanted.seen || wanted.bounces > 0;
  const std::vector<IrradianceSystem> systems = list_systems(task, seen);
  Stopwatch watch;
  BalancedTotals solved = solve_balanced(task, transport, systems);
  note_solver(solved.residual, solved.iterations, evidence);
  evidence.seconds.bounces += watch.lap();
  const bool checks =
      !wanted.totals.empty() && request.checks.totals && request.accuracy.visibility != Visibility::rays;
  if (checks) check_and_refine(task, transport, systems, solved, evidence);
  evidence.seconds.check += watch.lap();
  evidence.gathers = solved.gathers;
  auto next = solved.irradiance.begin();
  for (const Albedo& albedo : wanted.totals) {
    std::vector<TexelVector>& channels = results.totals.emplace_back();
    for (std::size_t c = 0; c < total_channels(wanted, albedo); ++c) {
      const auto i = static_cast<std::size_t>(next - solved.irradiance.begin());
      evidence.audits.push_back(audit_energy(task.surface, transport, systems[i], *next));
      evidence.audits.back().found_imbalance = solved.found_imbalance[i];
      channels.push_back(std::move(*next++));
    }
  }
  return seen ? std::move(*next) : TexelVector{};
}

}  // namespace heightlight
