#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "heightlight/error.h"
#include "solve/solver.h"
#include "visibility/distance_table.h"

namespace heightlight {
namespace {

constexpr int kMostBounces = 1000;

void check_albedo(const Surface& surface, const Albedo& albedo) {
  if (albedo.channels() == 0 || (!albedo.constant.empty() && !albedo.varying.empty())) {
    throw UsageError("albedo", "", "must have constant or varying channels, and not both");
  }
  const auto in_range = [](double value) { return value >= 0 && value <= 1; };
  const auto check = [&](const std::vector<double>& values) {
    if (!std::all_of(values.begin(), values.end(), in_range))
      throw UsageError("albedo", "", "must be in [0, 1]");
  };
  check(albedo.constant);
  for (const TexelVector& values : albedo.varying) {
    if (values.size() != surface.map.height.size()) {
      throw UsageError("albedo", "", "must have a value for every texel of the map");
    }
    check(values);
  }
}

void check_direct(const Surface& surface, const Wanted& wanted) {
  if (wanted.direct.empty()) return;
  for (const Albedo& albedo : wanted.totals) {
    if (wanted.direct.size() == 1 || albedo.channels() == 1 || albedo.channels() == wanted.direct.size())
      continue;
    throw UsageError("direct", "", "must have one channel, or those of the albedo");
  }
  const auto is_irradiance = [](double value) { return value >= 0 && std::isfinite(value); };
  for (const TexelVector& channel : wanted.direct) {
    if (channel.size() != surface.map.height.size())
      throw UsageError("direct", "", "must have a value for every texel of the map");
    if (!std::all_of(channel.begin(), channel.end(), is_irradiance))
      throw UsageError("direct", "", "must be finite and not negative");
  }
  if (wanted.bounces > 0 || wanted.seen) {
    throw UsageError("direct", "", "is for totals alone: single bounces and n are those of the sky's light");
  }
}

void check_definitions(const Wanted& wanted) {
  const std::set<SkyDefinition> different(wanted.definitions.begin(), wanted.definitions.end());
  if (different.size() != wanted.definitions.size())
    throw UsageError("definitions", "", "names a definition twice");
}

void check_below(const Wanted& wanted) {
  if (wanted.below == BelowHorizontal::sky || (!wanted.seen && wanted.bounces == 0)) return;
  throw UsageError(
      "below_horizontal", "ground",
      "is for maps of the sky and for totals: single bounces and n are those of a sky all around");
}

void check_accuracy(const Accuracy& accuracy, const Wanted& wanted) {
  if (accuracy.visibility == Visibility::rays) {
    check_ray_options({.rays = accuracy.rays, .seed = accuracy.seed});
    const bool horizons = !wanted.horizon_rad.empty() ||
                          !std::all_of(wanted.definitions.begin(), wanted.definitions.end(), is_of_sky);
    const bool more = wanted.moments.first || wanted.moments.second || horizons || wanted.maximum_distance;
    if (more) throw UsageError("visibility", "rays", "find shares of the sky and bounces, and nothing else");
    return;
  }
  if (accuracy.azimuths != 0) check_azimuths(accuracy.azimuths);
  if (accuracy.visibility == Visibility::exact_slices) return;
  if (accuracy.plan) check_horizon_plan(*accuracy.plan);
  if (!(accuracy.error > 0) || accuracy.error > 1) {
    throw UsageError("error", std::to_string(accuracy.error), "must be above 0, and 1 at most");
  }
}

void check_transport(const Surface& surface, const Request& request) {
  if (!request.transport) return;
  if (!request.transport->transport ||
      request.transport->transport->direct.size() != surface.map.height.size())
    throw UsageError("transport", "", "must be an operator of the surface");
  const SkyWanted& moments = request.wanted.moments;
  if (keeps_sky(request.wanted) && (moments.first || moments.second))
    throw UsageError("transport", "", "that is given tells shares of the sky, not its moments");
}

}  // namespace

void check_request(const Surface& surface, const Request& request) {
  const Wanted& wanted = request.wanted;
  if (wanted.bounces < 0 || wanted.bounces > kMostBounces) {
    throw UsageError("bounces", std::to_string(wanted.bounces),
                     "must be from 1 to " + std::to_string(kMostBounces));
  }
  if (wanted.maximum_distance) check_maximum_distance(*wanted.maximum_distance);
  for (const Albedo& albedo : wanted.totals) check_albedo(surface, albedo);
  check_direct(surface, wanted);
  check_definitions(wanted);
  check_below(wanted);
  check_accuracy(request.accuracy, wanted);
  check_transport(surface, request);
}

bool needs_operator(const Wanted& wanted) {
  return !wanted.totals.empty() || wanted.seen || wanted.bounces > 0;
}

std::size_t total_channels(const Wanted& wanted, const Albedo& albedo) {
  return std::max(albedo.channels(), wanted.direct.size());
}

bool keeps_sky(const Wanted& wanted) {
  return wants_sky(wanted) && !wanted.maximum_distance && wanted.below == BelowHorizontal::sky;
}

bool lights_from_above(const Wanted& wanted) {
  return wanted.below == BelowHorizontal::ground && !wanted.totals.empty() && wanted.direct.empty();
}

bool wants_sky(const Wanted& wanted) {
  return wanted.sky || wanted.moments.first || wanted.moments.second ||
         std::any_of(wanted.definitions.begin(), wanted.definitions.end(), is_of_sky);
}

}  // namespace heightlight
