#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bake/baked_map.h"
#include "files/image_file.h"

namespace heightlight {

/// The map that textures are of, as far as files tell of it.
struct BakedMap {
  const Material& material;  ///< of which the evidence and the light are told
  const Heightmap& header;   ///< all but the heights, of which the size counts
  double relief = 0;
  std::uint64_t missing = 0;
  std::string sha256 = {};  ///< of its file
  std::optional<Georeference> place = {};
  std::vector<Warning> warnings = {};
};

/// The values of a texture's channels, interleaved, before they are encoded; by its number.
using TextureValues = std::function<FillRows(std::size_t texture)>;

/// What the report of a bake is made of (BakeOptions::write_report).
struct ReportedBake {
  const BakedMap& map;
  const std::vector<BakedTexture>& textures;
  const TextureValues& values;
  const BakeOptions& options;
  const BakeTarget& target;
  const std::vector<std::string>& files;  ///< of the textures, in their order
  const std::vector<Warning>& warnings;
  double output_seconds = 0;  ///< that writing the textures took
};

/// Writes the files of a bake, whose values may be anywhere: the channels' own functions are not called.
/// Throws as bake_material does.
BakeOutcome write_textures(const BakedMap& map, const std::vector<BakedTexture>& textures,
                           const TextureValues& values, const BakeOptions& options, const BakeTarget& target);

}  // namespace heightlight
