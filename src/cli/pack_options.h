#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "bake/bake.h"
#include "heightlight/files.h"

namespace heightlight {

/// How files are packed and called, as text until it is read.
struct PackOptions {
  std::vector<std::string> packs;   ///< [NAME:]R=MAP|FILE,… each (pack_text.h)
  std::vector<std::string> inputs;  ///< NAME=FILE[:CHANNEL][:srgb] each
  std::string preset;
  std::filesystem::path preset_file;
  std::string name;         ///< of files; empty: as the preset has it, or {stem}_{map}
  std::string format = {};  ///< this and what follows: empty: as the preset has it, or by the map
  std::string depth = {};
  std::string normal_y = {};
  std::string preset_text = {};  ///< the preset, as it was read
};

/// Adds `--format --depth --normal-y --pack --input --preset --preset-file --name`.
void add_pack_options(CLI::App& command, PackOptions& options);

/// Reads them into `options`, whose maps are known: packs, names, and the y of normals. What a preset sets
/// and was not given, it sets in `pack`, too. Where a preset packs ao-n, that has no file of its own. Throws
/// UsageError for what makes no sense, Error naming a file of presets that is damaged.
void apply_pack_options(PackOptions& pack, BakeOptions& options);

/// The channels of files of a map's own: without placeholders, but not read.
std::vector<OwnChannel> own_channels_for(const BakeOptions& options, const std::filesystem::path& map);

/// Reads them. Throws Error naming a file that is of another size than the map, has no such channel, or has
/// samples outside [0, 1] or, where heights are present, NaN; MemoryError where `memory` does not hold them.
void read_own_channels(std::vector<OwnChannel>& channels, const Heightmap& map, std::uint64_t memory);

/// Fills in their checksums alone. Throws Error naming a file that cannot be read.
void find_checksums(std::vector<OwnChannel>& channels);

/// All of these options that results depend on beside packs, as one text; empty where none was given.
/// The channels of files have their checksums.
std::string pack_key(const PackOptions& pack, const BakeOptions& options);

}  // namespace heightlight
