#include "bake/baked_map.h"

#include <algorithm>
#include <utility>

#include "bake/map_text.h"
#include "bake/packed_texture.h"
#include "base/digits.h"

namespace heightlight {
namespace {

/// What files of a map hold which of its components: [first, last).
std::vector<std::pair<int, int>> split(int components, TextureFormat format) {
  constexpr int kMostInPng = 4;
  const int most = format == TextureFormat::png ? kMostInPng : format == TextureFormat::asc ? 1 : components;
  if (components <= most) return {{0, components}};
  const int part = most > 1 && components % 3 == 0 ? 3 : most;
  std::vector<std::pair<int, int>> parts;
  for (int first = 0; first < components; first += part) {
    parts.push_back({first, std::min(first + part, components)});
  }
  return parts;
}

std::vector<std::string> suffixes_of(MaterialMap map, const BakeOptions& options) {
  const std::string name = to_string(map);
  if (map == MaterialMap::bent_cone) return {name, name + "-spread"};
  const std::size_t parts = split(component_count(map, options), options.format).size();
  if (parts == 1) return {name};
  std::vector<std::string> suffixes;
  for (std::size_t i = 0; i < parts; ++i) suffixes.push_back(name + "-" + std::to_string(i));
  return suffixes;
}

/// At what scale a map was found, if at one.
std::string scale_text(MaterialMap map, const Material& material) {
  if (!is_local(map)) return "";
  return "; the Gaussian's standard deviation is " + in_digits(material.local.scale, 6) + " world units";
}

void add_textures(MaterialMap map, const Material& material, const BakeOptions& options,
                  std::vector<BakedTexture>& textures) {
  const std::vector<BakedChannel> channels = baked_channels(map, material, options);
  const std::vector<std::string> suffixes = suffixes_of(map, options);
  if (map == MaterialMap::bent_cone) {
    textures.push_back({suffixes[0], map_text(map, options), {channels.begin(), channels.begin() + 4}});
    textures.push_back({suffixes[1],
                        "bent cone, half-angle by spread: the cone about the normal whose "
                        "cosine-weighted directions have a mean of the same length",
                        {channels[4]}});
    return;
  }
  const auto parts = split(static_cast<int>(channels.size()), options.format);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    textures.push_back({suffixes[i],
                        map_text(map, options) + scale_text(map, material),
                        {channels.begin() + parts[i].first, channels.begin() + parts[i].second}});
    if (options.format == TextureFormat::png && textures.back().channels.size() == 2) {
      textures.back().channels.push_back(constant_channel(0));
    }
  }
}

}  // namespace

BakedChannel constant_channel(double value) {
  return {"constant", "1", 0, 1, value, [value](std::size_t) { return static_cast<float>(value); }};
}

int component_count(MaterialMap map, const BakeOptions& options) {
  switch (map) {
    case MaterialMap::ao:
    case MaterialMap::height:
    case MaterialMap::specular_occlusion:
    case MaterialMap::curvature:
    case MaterialMap::convexity:
    case MaterialMap::concavity:
    case MaterialMap::cavity:
    case MaterialMap::displacement:
      return 1;
    case MaterialMap::multibounce:
      return static_cast<int>(std::max(options.albedo.channels(), options.light_channels));
    case MaterialMap::direct:
      return static_cast<int>(options.light_channels);
    case MaterialMap::bent_normal:
      return options.bent_length ? 4 : 3;
    case MaterialMap::bent_cone:
      return 5;
    case MaterialMap::normal:
      return 3;
    case MaterialMap::ao_n:
      return 2;
    case MaterialMap::horizon:
      return options.horizon_azimuths;
    case MaterialMap::sh:
      return 9;
    default:
      return 1;  // definitions
  }
}

std::vector<BakedTexture> baked_textures(const Material& material, const BakeOptions& options) {
  std::vector<BakedTexture> textures;
  for (const MaterialMap map : options.maps) add_textures(map, material, options, textures);
  for (const PackedTexture& pack : options.packed)
    textures.push_back(packed_texture(pack, material, options));
  return textures;
}

std::size_t texture_channels(const BakeOptions& options) {
  std::size_t channels = 0;
  for (const PackedTexture& pack : options.packed) channels += pack.channels.size();
  for (const MaterialMap map : options.maps) {
    const auto components = static_cast<std::size_t>(component_count(map, options));
    const bool is_padded = options.format == TextureFormat::png && components == 2;  // by an empty one
    channels += components + (is_padded ? 1 : 0);
  }
  return channels;
}

std::vector<std::string> texture_suffixes(const BakeOptions& options) {
  std::vector<std::string> suffixes;
  for (const MaterialMap map : options.maps) {
    for (std::string& suffix : suffixes_of(map, options)) suffixes.push_back(std::move(suffix));
  }
  for (const PackedTexture& pack : options.packed) suffixes.push_back(pack.name);
  return suffixes;
}

}  // namespace heightlight
