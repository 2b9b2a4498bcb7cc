#include "bake/packed_texture.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "bake/map_text.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

BakedChannel of_map(const PackedChannel& packed, const Material& material, const BakeOptions& options) {
  BakedChannel channel =
      baked_channels(*packed.map, material, options)[static_cast<std::size_t>(packed.component)];
  channel.quantity.insert(0, std::string(to_string(*packed.map)) + ": ");
  return channel;
}

BakedChannel of_file(const OwnChannel& own) {
  const std::string which = own.channel.empty() ? "" : ", channel " + own.channel;
  return {own.path.filename().string() + which,
          "1",
          0,
          1,
          0,
          [&own](std::size_t i) { return own.values.values[i]; }};
}

/// Turned over: what was its lowest value is its highest.
BakedChannel inverted(BakedChannel channel) {
  const double ends = channel.low + channel.high;
  channel.quantity.insert(0, ends == 1 ? "1 - " : ends == 0 ? "- " : "inverted ");
  channel.missing = ends - channel.missing;
  channel.value = [value = std::move(channel.value), ends = static_cast<float>(ends)](std::size_t i) {
    return ends - value(i);
  };
  return channel;
}

/// The map that all channels are of, as it is; nothing where they are of several, or of something else.
std::optional<MaterialMap> only_map(const PackedTexture& pack) {
  const std::optional<MaterialMap> first = pack.channels.front().map;
  const bool alike =
      std::all_of(pack.channels.begin(), pack.channels.end(),
                  [&](const PackedChannel& channel) { return channel.map == first && !channel.is_inverted; });
  return alike ? first : std::nullopt;
}

}  // namespace

void check_packs(const BakeOptions& options) {
  for (const PackedTexture& pack : options.packed) {
    for (const PackedChannel& channel : pack.channels) {
      if (!channel.map || channel.component < component_count(*channel.map, options)) continue;
      throw UsageError(
          "pack", "",
          std::string(to_string(*channel.map)) + " has no component " + std::to_string(channel.component));
    }
  }
}

BakedTexture packed_texture(const PackedTexture& pack, const Material& material, const BakeOptions& options) {
  const std::optional<MaterialMap> map = only_map(pack);
  BakedTexture texture{pack.name, map ? map_text(*map, options) : "channels of several maps", {}};
  for (const PackedChannel& packed : pack.channels) {
    BakedChannel channel = packed.own   ? of_file(options.own[*packed.own])
                           : packed.map ? of_map(packed, material, options)
                                        : constant_channel(packed.constant);
    if (packed.is_inverted) channel = inverted(std::move(channel));
    channel.is_srgb = pack.is_srgb && texture.channels.size() < 3;  // alpha is linear everywhere
    texture.channels.push_back(std::move(channel));
  }
  return texture;
}

}  // namespace heightlight
