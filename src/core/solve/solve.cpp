#include "heightlight/solve.h"

#include <cmath>
#include <string>

#include "base/byte_size.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/texel_algebra.h"
#include "base/texels.h"
#include "heightlight/error.h"
#include "solve/sky_check.h"
#include "solve/solver.h"

namespace heightlight {
namespace {

Evidence begin_evidence(const Request& request) {
  const Accuracy& accuracy = request.accuracy;
  const bool walks = accuracy.visibility == Visibility::horizon_walks;
  const bool slices = accuracy.visibility == Visibility::exact_slices;
  Evidence evidence;
  evidence.visibility = accuracy.visibility;
  evidence.error_wanted = walks ? accuracy.error : 0;
  if (slices) evidence.azimuths = accuracy.azimuths > 0 ? accuracy.azimuths : kExactAzimuths;
  if (accuracy.visibility == Visibility::rays) evidence.rays = accuracy.rays;
  evidence.seed = accuracy.seed;
  evidence.threads = thread_count();
  return evidence;
}

/// Bytes that the limit leaves.
std::uint64_t memory_left(const Surface& surface, const Request& request, Evidence& evidence) {
  const std::uint64_t needed = estimate_memory(surface.width(), surface.height(), request);
  evidence.estimated_bytes = needed;
  if (needed < request.limits.memory) return request.limits.memory - needed;
  throw MemoryError(std::to_string(surface.width()) + " × " + std::to_string(surface.height()) +
                    " texels need " + format_byte_size(needed) + " beside any links, more than the " +
                    format_byte_size(request.limits.memory) + " of memory allowed");
}

void check_results(const Task& task, Results& results) {
  const Request& request = task.request;
  const Accuracy& accuracy = request.accuracy;
  Evidence& evidence = results.evidence;
  if (accuracy.visibility == Visibility::rays) {
    if (!request.checks.sky && !request.checks.totals) return;
    const double rmse = estimate_ray_rmse(task.surface, {.rays = accuracy.rays, .seed = accuracy.seed});
    if (!std::isnan(rmse)) evidence.sky_rmse = rmse;
    return;
  }
  if (!request.checks.sky || results.sky_view_factor.size() == 0) return;
  const bool more = results.moments.first.size() > 0 || request.wanted.reach;
  if (!evidence.total_checks.empty() && !more) {
    const HorizonCheck& check = evidence.total_checks[0];  // its receivers told of the sky already
    evidence.sky_check = {.receivers = check.receivers,
                          .azimuths = check.azimuths,
                          .ambient_occlusion = check.ambient_rmse,
                          .sky_view_factor = check.sky_rmse};
    return;
  }
  const CheckedSky sky{.ambient_occlusion = results.ambient_occlusion,
                       .sky_view_factor = results.sky_view_factor,
                       .moments = results.moments};
  evidence.sky_check = check_sky(task.surface, sky, request.wanted.reach, accuracy.seed, request.watch);
  if (evidence.sky_check && !evidence.sky_rmse) evidence.sky_rmse = evidence.sky_check->sky_view_factor;
}

}  // namespace

Results solve(const Surface& surface, const Request& request) {
  check_request(surface, request);
  const ThreadScope threads(request.limits.threads);
  Results results;
  Evidence& evidence = results.evidence;
  evidence = begin_evidence(request);
  const Task task{
      .surface = surface, .request = request, .free_memory = memory_left(surface, request, evidence)};
  const Wanted& wanted = request.wanted;
  if (needs_operator(wanted)) find_light(task, results);
  Stopwatch watch;
  const bool wants_sky = wanted.sky || wanted.moments.first || wanted.moments.second;
  if (!wanted.horizon_rad.empty() || (wants_sky && results.sky_view_factor.size() == 0))
    find_sky(task, results);
  evidence.seconds.visibility += watch.lap();
  check_results(task, results);
  evidence.seconds.check += watch.lap();
  if (evidence.plan) evidence.azimuths = evidence.plan->sky.walk.azimuths;
  evidence.estimated_bytes += evidence.link_bytes;
  return results;
}

PlannedTransport find_operator(const Surface& surface, const Request& request) {
  Request bounced = request;
  bounced.wanted = {.totals = {{.constant = {0}}}};  // something that an operator is found for
  check_request(surface, bounced);
  const ThreadScope threads(request.limits.threads);
  Evidence evidence;
  const Task task{
      .surface = surface, .request = bounced, .free_memory = memory_left(surface, bounced, evidence)};
  return find_operator(task, request.accuracy.error, {});
}

Image<Vector3> bent_normals(const SkyMoments& moments, const Surface& surface) {
  Image<Vector3> bent(surface.width(), surface.height());
  for_texels(bent, [&](std::size_t i) {
    bent.values[i] = bent_normal(moments.first.values[i], surface.normal.values[i]);
  });
  return bent;
}

}  // namespace heightlight
