#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bake/bake.h"

// A pack as text: [NAME:]CHANNELS=SOURCE,… where CHANNELS are one or more of R, G, B, A, and a SOURCE is
//   MAP or MAP.COMPONENT      a map that is baked: ao, normal.z, sh.8
//   FILE[:CHANNEL][:srgb]     a file of the user's own: rough.png, metal.png:R, gloss.exr:Y, tint.png:R:srgb
//   INPUT                     the file that an input of this name was given, or what stands in for it
//   a number                  from 0 to 1
// and 1-SOURCE is 1 less it. Several letters take components (channels) one after the other: RGB=normal.

namespace heightlight {

/// A file as text, in whose path placeholders stand for what differs from map to map.
struct FileText {
  std::string path;
  std::string channel = {};
  bool is_srgb = false;
};

/// "metal.png:R:srgb" of the option `quantity`. Throws UsageError for an empty channel or placeholders that
/// are not known.
FileText parse_file_text(const std::string& quantity, const std::string& text);

/// The path of a file that belongs to a map: {stem} and {folder} are of that map's file, {material} as
/// material_name has it.
std::filesystem::path path_for_map(const std::string& path, const std::filesystem::path& map);

/// A name for a file of the user's own.
struct PackInput {
  std::string name;
  double stand_in = 0;  ///< where no file was given
  std::optional<FileText> file = {};
  bool is_taken = false;  ///< by a pack
};

/// What packs refer to.
struct PackSources {
  std::vector<PackInput> inputs = {};
  std::vector<OwnChannel> own = {};  ///< channels of files that they took, with placeholders in their paths
};

/// The pack of a text, unnamed "packed". Adds to `sources` what it takes. Throws UsageError of `pack`.
PackedTexture parse_pack(const std::string& text, PackSources& sources);

}  // namespace heightlight
