#include <algorithm>

#include "heightlight/solve.h"
#include "solve/solver.h"
#include "surface/maximum_pyramid.h"
#include "transport/bounce_check.h"
#include "transport/gather_calibration.h"
#include "transport/map_gather.h"
#include "transport/sky_calibration.h"
#include "visibility/height_pyramid.h"
#include "visibility/horizon_sky.h"

// What is held at once, from the types that hold it: the surface, its pyramids and what has been found are
// there all the time; planning, solving for totals and bouncing come one after the other.

namespace heightlight {
namespace {

constexpr std::uint64_t kVector = sizeof(TexelVector::value_type);
constexpr std::uint64_t kMap = sizeof(Map::value_type);

std::uint64_t channels_of(const Wanted& wanted) {
  std::uint64_t channels = 0;
  for (const Albedo& albedo : wanted.totals) channels += total_channels(wanted, albedo);
  return channels;
}

/// Vectors of BiCGSTAB as Eigen has it (r, r₀, p, v, s, t, y, z, x and the right side), the product's copies
/// of its argument, and what is gathered.
constexpr std::uint64_t kSolverVectors = 10 + 3;

/// Maps of a system on its way: E twice, sums of what was seen and of its weights.
constexpr std::uint64_t kSystemMaps = 4;

bool by_walks(const Request& request) { return request.accuracy.visibility == Visibility::horizon_walks; }

/// Systems that are solved: those of totals, and the one at kSeenAlbedo.
std::uint64_t count_systems(const Wanted& wanted) {
  return channels_of(wanted) + (wanted.seen || wanted.bounces > 0 ? 1 : 0);
}

/// Per texel, of what bounces and totals leave behind.
std::uint64_t irradiance_bytes(const Request& request) {
  const Wanted& wanted = request.wanted;
  const std::uint64_t stored =
      wanted.bounces > 0 && !request.sink ? static_cast<std::uint64_t>(wanted.bounces + 1) : 0;
  return kVector * (count_systems(wanted) + stored) + (wanted.seen ? 2 * kMap : 0);
}

/// Of solving for totals: the systems, with the heights that gathers look at and the fields that one reads at
/// once.
std::uint64_t solving_bytes(int width, int height, const Request& request) {
  const auto texels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  const std::uint64_t systems = count_systems(request.wanted);
  if (!by_walks(request)) return texels * kSolverVectors * kVector;
  return texels * systems * kSystemMaps * kMap +
         gather_bytes(width, height, std::min<std::uint64_t>(kMostFields, systems));
}

/// Of bounces: E_b, E_{b+1}, their sum and what walks keep (E_{b−1} and L twice, sums, a field) or the tail.
/// They may look more closely than totals do, whose gather stays.
std::uint64_t bouncing_bytes(int width, int height, const Request& request) {
  if (request.wanted.bounces == 0) return 0;
  const auto texels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  const std::uint64_t gathers =
      by_walks(request) ? gather_bytes(width, height, 1) + gather_bytes(width, height, 0) : 0;
  const std::uint64_t check = request.checks.bounces ? BounceCheck::bytes(width, height) : 0;
  const std::uint64_t tail = by_walks(request) ? 0 : kSolverVectors * kVector;
  return texels * (6 * kVector + 2 * kMap + tail) + gathers + check;
}

/// Of planning walks: what calibrates them, the best gather so far, and the next, which is tried on a
/// radiosity that the sky or each channel of one's own may make.
std::uint64_t planning_bytes(int width, int height, const Request& request) {
  if (!by_walks(request)) return 0;
  const std::uint64_t sky = sky_calibration_bytes(width, height);
  if (!needs_operator(request.wanted)) return sky;
  const auto texels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  const std::uint64_t radiosities = std::max<std::uint64_t>(1, request.wanted.direct.size());
  return sky + gather_calibration_bytes(width, height, radiosities) + gather_bytes(width, height, 1) +
         gather_bytes(width, height, 0) + texels * radiosities * kMap;
}

/// What comes one after the other: each has gone when the next begins.
std::uint64_t passing_bytes(int width, int height, const Request& request) {
  const std::uint64_t planning = planning_bytes(width, height, request);
  if (!needs_operator(request.wanted)) return planning;
  return std::max({planning, solving_bytes(width, height, request), bouncing_bytes(width, height, request)});
}

}  // namespace

std::uint64_t estimate_memory(int width, int height, const Request& request) {
  const Wanted& wanted = request.wanted;
  const auto texels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  std::uint64_t per_texel = kMap + sizeof(Vector3);
  const bool wants_any = wants_sky(wanted) || !wanted.horizon_rad.empty() || !wanted.definitions.empty();
  if (!wants_any && !needs_operator(wanted)) return texels * per_texel;
  per_texel += horizon_sky_bytes(wanted.moments) + kMap * wanted.horizon_rad.size();
  per_texel += kMap * wanted.definitions.size();
  std::uint64_t pyramids = height_pyramid_bytes(width, height);
  pyramids += maximum_pyramid_bytes(width, height);  // of exact walks: those that calibrate, the checks'
  if (std::find(wanted.definitions.begin(), wanted.definitions.end(), SkyDefinition::openness_negative) !=
      wanted.definitions.end())
    per_texel += kMap + sizeof(Vector3);  // the surface upside down; its pyramids come after the others
  if (lights_from_above(wanted)) per_texel += kVector + horizon_sky_bytes({});
  if (needs_operator(wanted)) {
    per_texel += kVector + irradiance_bytes(request);  // the direct irradiance
    if (wanted.maximum_distance && (wanted.sky || wanted.moments.first)) per_texel += horizon_sky_bytes({});
  }
  return texels * per_texel + pyramids + passing_bytes(width, height, request);
}

std::uint64_t refinement_bytes(int width, int height, const Wanted& wanted) {
  const auto texels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  return texels * (horizon_sky_bytes({}) + kVector * (1 + channels_of(wanted))) +
         gather_bytes(width, height, 0);
}

}  // namespace heightlight
