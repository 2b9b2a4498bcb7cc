#include "bake/bake_memory.h"

#include <algorithm>

#include "bake/baked_map.h"
#include "bake/local_maps.h"
#include "bake/material.h"
#include "base/parallel.h"
#include "files/image_file.h"
#include "visibility/horizon_sky.h"

namespace heightlight {
namespace {

constexpr std::uint64_t kVector = sizeof(TexelVector::value_type);
constexpr std::uint64_t kMap = sizeof(Map::value_type);

std::uint64_t count_texels(int width, int height) {
  return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

/// Per texel: the surface, what a solution leaves, and totals as they become maps.
std::uint64_t kept_bytes(const Wanted& wanted, std::size_t channels) {
  return kMap + sizeof(Vector3) + horizon_sky_bytes(wanted.moments) +
         kMap * (wanted.definitions.size() + wanted.horizon_rad.size() + (wanted.seen ? 2 : 0)) +
         (kVector + kMap) * channels;
}

/// Textures are written at the same time, one a thread.
std::uint64_t writing_bytes(int width, const BakeOptions& options) {
  const std::size_t textures = texture_suffixes(options).size();
  std::uint64_t most_channels = 0;
  for (const PackedTexture& pack : options.packed)
    most_channels = std::max(most_channels, static_cast<std::uint64_t>(pack.channels.size()));
  for (const MaterialMap map : options.maps)
    most_channels = std::max(most_channels, static_cast<std::uint64_t>(component_count(map, options)));
  const auto writers = std::min(textures, static_cast<std::size_t>(thread_count()));
  return writers * texture_writing_bytes(width, most_channels, options.format == TextureFormat::tif);
}

}  // namespace

std::uint64_t bytes_beside_solution(int width, int height, const BakeOptions& options) {
  return count_texels(width, height) * (kVector * (options.light_channels + options.albedo.varying.size()) +
                                        kMap * options.own.size() + kept_local_bytes(options));
}

std::uint64_t bake_bytes(int width, int height, const BakeOptions& options) {
  const Request request = material_request(options, AzimuthConvention::math);
  const bool has_totals = is_wanted(options, MaterialMap::multibounce);
  const std::size_t channels = has_totals ? std::max(options.albedo.channels(), options.light_channels) : 0;
  const std::uint64_t texels = count_texels(width, height);
  const std::uint64_t kept = texels * kept_bytes(request.wanted, channels);
  const std::uint64_t drawing = options.draw_sheet ? kept + kSheetBytes + 2 * kMap * texels : 0;
  return bytes_beside_solution(width, height, options) +
         std::max({estimate_memory(width, height, request), kept + writing_bytes(width, options), drawing,
                   texels * (kMap + sizeof(Vector3) + passing_local_bytes(options))});
}

}  // namespace heightlight
