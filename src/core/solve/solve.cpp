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
  if (needed <= request.limits.memory) return request.limits.memory - needed;
  throw MemoryError(std::to_string(surface.width()) + " × " + std::to_string(surface.height()) +
                        " texels need " + format_byte_size(needed) + " beside any links, more than the " +
                        format_byte_size(request.limits.memory) + " of memory allowed",
                    needed - request.limits.memory, write_enough(needed));
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
  const bool more = results.moments.first.size() > 0 || request.wanted.maximum_distance ||
                    request.wanted.below == BelowHorizontal::ground;
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
                       .moments = results.moments,
                       .maximum_distance = request.wanted.maximum_distance,
                       .below = request.wanted.below};
  evidence.sky_check = check_sky(task.surface, sky, accuracy.seed, request.watch);
  const bool of_operator = evidence.sky_rmse && request.wanted.below == BelowHorizontal::sky;
  if (evidence.sky_check && !of_operator) evidence.sky_rmse = evidence.sky_check->sky_view_factor;
}

/// E₀/π of a sky that has nothing below the horizontal, without a maximum distance. It is kept where it is
/// the sky that was asked for.
TexelVector find_irradiance_from_above(const Task& task, Results& results) {
  // Of the error wanted: bounces pass on what the direct irradiance errs by, and gathers err, too.
  constexpr double kShare = 0.6;
  const Request& request = task.request;
  const bool keeps = wants_sky(request.wanted) && !request.wanted.maximum_distance;
  Request of_sky{.wanted = {.sky = true,
                            .moments = keeps ? request.wanted.moments : SkyWanted{},
                            .below = BelowHorizontal::ground},
                 .accuracy = request.accuracy,
                 .watch = request.watch};
  of_sky.accuracy.error *= kShare;
  Results found;
  found.evidence = results.evidence;
  find_sky({.surface = task.surface, .request = of_sky}, found);
  results.evidence.plan = found.evidence.plan;
  TexelVector direct(found.sky_view_factor.size());
  for_texels(found.sky_view_factor, [&](std::size_t i) {
    const float share = found.sky_view_factor.values[i];
    direct[i] = std::isnan(share) ? 0 : double{share};
  });
  if (keeps) {
    results.ambient_occlusion = std::move(found.ambient_occlusion);
    results.sky_view_factor = std::move(found.sky_view_factor);
    results.moments = std::move(found.moments);
  }
  return direct;
}

}  // namespace

Results solve(const Surface& surface, const Request& request) {
  check_request(surface, request);
  const ThreadScope threads(request.limits.threads);
  Results results;
  Evidence& evidence = results.evidence;
  evidence = begin_evidence(request);
  const Wanted& wanted = request.wanted;
  Task task{.surface = surface,
            .request = request,
            .direct = wanted.direct,
            .free_memory = memory_left(surface, request, evidence)};
  Stopwatch watch;
  std::vector<TexelVector> from_above;
  if (lights_from_above(wanted)) {
    from_above.push_back(find_irradiance_from_above(task, results));
    task.direct = from_above;
  }
  evidence.seconds.visibility += watch.lap();
  if (needs_operator(wanted)) find_irradiance(task, results);
  watch.lap();
  if (!wanted.horizon_rad.empty() || (wants_sky(wanted) && results.sky_view_factor.size() == 0))
    find_sky(task, results);
  if (!wanted.definitions.empty()) find_definitions(task, results);
  evidence.seconds.visibility += watch.lap();
  check_results(task, results);
  evidence.seconds.check += watch.lap();
  if (evidence.plan) evidence.azimuths = evidence.plan->sky.walk.azimuths;
  take_definitions_of_sky(task, results);
  evidence.estimated_bytes += evidence.link_bytes;
  return results;
}

PlannedTransport find_operator(const Surface& surface, const Request& request) {
  Request bounced = request;
  bounced.wanted = {.totals = {{.constant = {0}}},  // something that an operator is found for
                    .direct = request.wanted.direct};
  check_request(surface, bounced);
  const ThreadScope threads(request.limits.threads);
  Evidence evidence;
  const Task task{.surface = surface,
                  .request = bounced,
                  .direct = bounced.wanted.direct,
                  .free_memory = memory_left(surface, bounced, evidence)};
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
