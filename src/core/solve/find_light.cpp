#include <algorithm>
#include <memory>

#include "base/stopwatch.h"
#include "solve/solver.h"

namespace heightlight {
namespace {

/// The operator; with horizon walks, moments of its sky, and how it walks.
PlannedTransport find_operator(const Task& task) {
  const Request& request = task.request;
  const Accuracy& accuracy = request.accuracy;
  const LinkLimits limits{.memory = task.link_memory, .watch = request.watch};
  const RayOptions rays{.rays = accuracy.rays, .seed = accuracy.seed};
  PlannedTransport found;
  if (accuracy.visibility == Visibility::rays) {
    found.transport = std::make_unique<FormFactors>(build_form_factors(task.surface, rays, limits));
  } else if (accuracy.visibility == Visibility::exact_slices) {
    const int azimuths = task.request.accuracy.azimuths > 0 ? accuracy.azimuths : kExactAzimuths;
    found.transport = std::make_unique<FormFactors>(build_exact_form_factors(task.surface, azimuths, limits));
  } else if (accuracy.plan) {
    found.transport = build_horizon_transport(task.surface, *accuracy.plan, limits);
    found.plan = *accuracy.plan;
  } else {
    const bool keeps = keeps_sky(request.wanted);
    const HorizonGoal goal =
        plan_goal(request, !keeps && !request.wanted.seen, keeps && request.wanted.moments.first);
    found = plan_horizon_transport(task.surface, goal, limits, keeps ? request.wanted.moments : SkyWanted{});
  }
  return found;
}

/// The channel of an albedo that reflects most.
std::size_t brightest_channel(const Albedo& albedo) {
  const auto& constant = albedo.constant;
  if (!constant.empty()) {
    return static_cast<std::size_t>(std::max_element(constant.begin(), constant.end()) - constant.begin());
  }
  const auto sum = [](const TexelVector& values) {
    double all = 0;
    for (const double value : values) all += value;
    return all;
  };
  std::size_t brightest = 0;
  for (std::size_t i = 1; i < albedo.varying.size(); ++i) {
    if (sum(albedo.varying[i]) > sum(albedo.varying[brightest])) brightest = i;
  }
  return brightest;
}

/// By exact walks, all of them from the same receivers.
void check_totals(const Task& task, const Transport& transport, Results& results) {
  const Wanted& wanted = task.request.wanted;
  std::vector<CheckedTotal> totals;
  for (std::size_t a = 0; a < wanted.totals.size(); ++a) {
    const Albedo& albedo = wanted.totals[a];
    const std::size_t channel = brightest_channel(albedo);
    totals.push_back({.total = results.totals[a][channel],
                      .albedo = albedo.varying.empty() ? albedo.constant[channel] : 0,
                      .varying = albedo.varying.empty() ? nullptr : &albedo.varying[channel],
                      .direct = wanted.direct.empty() ? nullptr : &wanted.direct});
  }
  std::vector<HorizonCheck> checks = check_by_exact_walks(task.surface, transport.direct, totals,
                                                          task.request.accuracy.seed, task.request.watch);
  if (checks[0].receivers == 0) return;
  results.evidence.sky_rmse = checks[0].sky_rmse;
  results.evidence.total_checks = std::move(checks);
}

void describe_operator(const PlannedTransport& found, const Task& task, Evidence& evidence) {
  if (task.request.accuracy.visibility == Visibility::horizon_walks) evidence.plan = found.plan;
  evidence.has_links = true;
  evidence.links = found.transport->link_count();
  evidence.link_bytes = found.transport->bytes();
}

}  // namespace

void find_light(const Task& task, Results& results) {
  const Request& request = task.request;
  const Wanted& wanted = request.wanted;
  SolveTimes& seconds = results.evidence.seconds;
  Stopwatch watch;
  PlannedTransport found = find_operator(task);
  Transport& transport = *found.transport;
  seconds.visibility += watch.lap();
  describe_operator(found, task, results.evidence);
  if (wanted.bounces > 0 && request.checks.energy) {
    results.evidence.energy.emplace().row_sum_max_error = row_sum_error(transport);
  }
  seconds.transport += watch.lap();
  if (wanted.bounces > 0) {
    solve_bounces(task, transport, results);
  } else {
    solve_totals_only(task, transport, results);
  }
  seconds.bounces += watch.lap() - seconds.sink;
  const bool by_rays = request.accuracy.visibility == Visibility::rays;
  if (!wanted.totals.empty() && request.checks.totals && !by_rays) check_totals(task, transport, results);
  seconds.check += watch.lap();
  if (wanted.seen) results.whole_sky_view_factor = transport.sky_view_factor;
  if (!keeps_sky(wanted)) return;
  results.ambient_occlusion = std::move(transport.ambient_occlusion);
  results.sky_view_factor = std::move(transport.sky_view_factor);
  results.moments = std::move(found.moments);
}

}  // namespace heightlight
