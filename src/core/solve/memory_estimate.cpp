#include <algorithm>

#include "heightlight/solve.h"
#include "solve/solver.h"
#include "surface/maximum_pyramid.h"
#include "transport/bounce_check.h"
#include "transport/horizon_pilot.h"
#include "transport/map_gather.h"
#include "visibility/height_mips.h"
#include "visibility/horizon_sky.h"

// What is held at once, from the types that hold it. The worst moment is the last gather, or the check after
// it: the surface and its pyramids are there all the time, the sky's maps from then on.

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

/// Per texel, of the bounces and totals: their vectors beside the operator.
std::uint64_t light_bytes(const Request& request) {
  const Wanted& wanted = request.wanted;
  const std::uint64_t systems = channels_of(wanted) + (wanted.seen || wanted.bounces > 0 ? 1 : 0);
  const bool walks = request.accuracy.visibility == Visibility::horizon_walks;
  std::uint64_t bytes = kVector * systems + (wanted.seen ? 2 * kMap : 0);
  const std::uint64_t solving = walks ? systems * kSystemMaps * kMap : kSolverVectors * kVector;
  // E_b, E_{b+1}, their sum and what walks keep (E_{b−1} and L twice, sums, a field) or the tail: they are
  // gone when totals are solved for.
  const std::uint64_t bouncing = wanted.bounces > 0 ? 6 * kVector + 2 * kMap : 0;
  bytes += std::max(solving, bouncing);
  if (wanted.bounces > 0 && !request.sink) bytes += kVector * static_cast<std::uint64_t>(wanted.bounces + 1);
  return bytes;
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
  std::uint64_t pyramids = height_mips_bytes(width, height);
  pyramids += maximum_pyramid_bytes(width, height);  // of exact walks: the pilot's, the checks'
  if (std::find(wanted.definitions.begin(), wanted.definitions.end(), SkyDefinition::openness_negative) !=
      wanted.definitions.end())
    per_texel += kMap + sizeof(Vector3);  // the surface upside down; its pyramids come after the others
  if (lights_from_above(wanted)) per_texel += kVector + horizon_sky_bytes({});
  if (request.accuracy.visibility == Visibility::horizon_walks)
    pyramids += horizon_pilot_bytes(width, height);
  if (needs_operator(wanted)) {
    per_texel += kVector + light_bytes(request);  // the direct light
    if (request.accuracy.visibility == Visibility::horizon_walks) {
      // The heights that gathers look at, and the fields that one reads at once.
      const std::uint64_t fields = std::min<std::uint64_t>(
          kMostFields, channels_of(wanted) + (wanted.seen || wanted.bounces > 0 ? 1 : 0));
      pyramids += gather_bytes(width, height, fields);
      if (wanted.bounces > 0) pyramids += gather_bytes(width, height, 0);  // bounces may look more closely
    }
    if (wanted.bounces > 0 && request.checks.bounces) pyramids += BounceCheck::bytes(width, height);
    if (wanted.reach && (wanted.sky || wanted.moments.first)) per_texel += horizon_sky_bytes({});
  }
  return texels * per_texel + pyramids;
}

std::uint64_t refinement_bytes(int width, int height, const Wanted& wanted) {
  const auto texels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  return texels * (horizon_sky_bytes({}) + kVector * (1 + channels_of(wanted))) +
         gather_bytes(width, height, 0);
}

}  // namespace heightlight
