#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bake/bake.h"
#include "cli/bake_inputs.h"
#include "cli/light_options.h"
#include "cli/map_options.h"
#include "cli/pack_options.h"
#include "cli/relief_table.h"

namespace heightlight {

/// What `heightlight bake` was asked for, as text until it is read.
struct BakeCommand {
  std::vector<std::filesystem::path> inputs;
  LoadOptions load;
  RunOptions run;
  std::filesystem::path folder;
  BakeOptions options;
  std::string maps;
  PackOptions pack;
  std::string albedo = "0.5";
  LightOptions light;              ///< of multibounce and direct
  std::string roughness = "0.13";  ///< of specular-occlusion
  std::string view = "0,90";
  std::string max_distance;
  std::string falloff = "none";
  bool skip_existing = false;
  bool json = false;                ///< a line of JSON per map instead of a report
  std::optional<int> windows = {};  ///< bake window by window, of so many texels a side; 0: as memory has it
  std::string pattern;
  bool sheet = false;                     ///< a picture of each material
  std::string reliefs;                    ///< a file, or NAME=RELIEF,…
  std::vector<NamedRelief> relief_table;  ///< what it says
  std::string match;                      ///< a normal or AO map whose relief is to be found
  std::string match_sha256;               ///< of that file
  std::string relief_from;                ///< how `load.relief` was found, where it was
  std::string detail_scale;               ///< of curvature and cavity
  bool report = false;                    ///< also write NAME_report.html
  std::string window;                     ///< COLUMN,ROW,WIDTH,HEIGHT; empty: the whole map
};

/// Bakes all maps of the command, which it reads first. Throws Error after the last one where some could not
/// be baked, and UsageError before the first one for a request that makes no sense.
void bake(BakeCommand& command);

/// Reads the texts, all that does not depend on a map. Throws UsageError for what no map can be baked with.
void parse_bake_options(BakeCommand& command);

/// The command as it is for one map: with the relief that the table names for it.
BakeCommand command_for(const BakeCommand& command, const std::filesystem::path& map);

/// The options of one map's files, whose format may hang on what that map is.
BakeOptions options_for(const BakeCommand& command, const std::filesystem::path& map);

/// All that a map's files depend on, as one text: with the text of its .prj, and the checksums of the
/// heightmap and of the albedo, where that is a file, as they were read. `options` are those of the map.
std::string request_of(const BakeCommand& command, const BakeOptions& options, const std::string& map_sha256,
                       const std::string& albedo_sha256);

/// Of that, what the heights depend on.
std::string surface_of(const BakeCommand& command, const BakeOptions& options, const std::string& map_sha256);

/// Whether the files are there as they were written, of this heightmap, and as is asked for now. Throws Error
/// for an input that cannot be read.
bool is_baked(const BakeCommand& command, const BakeInput& input);

}  // namespace heightlight
