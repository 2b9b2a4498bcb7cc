#include <algorithm>
#include <memory>

#include "base/stopwatch.h"
#include "heightlight/closed_forms.h"
#include "solve/solver.h"

namespace heightlight {
namespace {

void describe_operator(const PlannedTransport& found, const Task& task, Evidence& evidence) {
  if (task.request.accuracy.visibility == Visibility::horizon_walks) {
    const std::optional<HorizonPlan> from_above = evidence.plan;  // of a sky that is not the operator's
    evidence.plan = found.plan;
    if (from_above) evidence.plan->sky = from_above->sky;
  }
  evidence.has_links = true;
  evidence.links = found.transport->link_count();
  evidence.link_bytes = found.transport->bytes();
}

}  // namespace

PlannedTransport find_operator(const Task& task, double error, const SkyWanted& moments) {
  const Request& request = task.request;
  const Accuracy& accuracy = request.accuracy;
  const LinkLimits limits{.memory = task.free_memory, .watch = request.watch};
  const RayOptions rays{.rays = accuracy.rays, .seed = accuracy.seed};
  PlannedTransport found;
  if (accuracy.visibility == Visibility::rays) {
    found.transport = std::make_unique<FormFactors>(build_form_factors(task.surface, rays, limits));
  } else if (accuracy.visibility == Visibility::exact_slices) {
    const int azimuths = task.request.accuracy.azimuths > 0 ? accuracy.azimuths : kExactAzimuths;
    found.transport = std::make_unique<FormFactors>(build_exact_form_factors(task.surface, azimuths, limits));
  } else if (accuracy.plan) {
    found.transport = build_horizon_transport(task.surface, *accuracy.plan, error, request.watch);
    found.plan = *accuracy.plan;
  } else {
    HorizonGoal goal = plan_goal(request, keeps_sky(request.wanted) && request.wanted.moments.first);
    goal.error = error;
    goal.direct = task.direct;
    found = plan_horizon_transport(task.surface, goal, moments, request.watch);
  }
  return found;
}

void find_irradiance(const Task& task, Results& results) {
  const Request& request = task.request;
  const Wanted& wanted = request.wanted;
  Evidence& evidence = results.evidence;
  Stopwatch watch;
  PlannedTransport own;
  if (!request.transport)
    own = find_operator(task, request.accuracy.error, keeps_sky(wanted) ? wanted.moments : SkyWanted{});
  const PlannedTransport& found = request.transport ? *request.transport : own;
  const Transport& transport = *found.transport;
  describe_operator(found, task, evidence);
  evidence.seconds.visibility += watch.lap();
  if (const auto* links = dynamic_cast<const FormFactors*>(&transport); links && request.sink) {
    request.sink->take_links(*links);
    evidence.seconds.sink += watch.lap();
  }
  const double for_links = evidence.seconds.sink;
  if (wanted.bounces > 0 && request.checks.energy) evidence.energy.emplace();
  const TexelVector at_seen_albedo = find_totals(task, transport, results);
  watch.lap();
  if (wanted.bounces > 0) {
    if (evidence.energy) {
      const RowSumError row_sums = row_sum_error(transport);
      evidence.energy->row_sum_max_error = row_sums.largest;
      evidence.energy->row_sum_rmse = row_sums.rms;
    }
    evidence.seconds.transport += watch.lap();
    solve_bounces(task, transport, results);
    evidence.seen->deep = deep_seen(transport, at_seen_albedo);
  }
  if (wanted.seen) results.seen = solve_seen(transport.sky_view_factor, at_seen_albedo);
  evidence.seconds.bounces += watch.lap() - (evidence.seconds.sink - for_links);
  if (wanted.seen) results.whole_sky_view_factor = transport.sky_view_factor;
  if (!keeps_sky(wanted)) return;
  if (request.transport) {
    results.ambient_occlusion = transport.ambient_occlusion;
    results.sky_view_factor = transport.sky_view_factor;
    return;
  }
  results.ambient_occlusion = std::move(own.transport->ambient_occlusion);
  results.sky_view_factor = std::move(own.transport->sky_view_factor);
  results.moments = std::move(own.moments);
}

}  // namespace heightlight
