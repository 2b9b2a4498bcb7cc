#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bake/texture_files.h"
#include "files/file_record.h"

namespace heightlight {

/// What the sidecar tells beside what the material knows.
struct SidecarFacts {
  std::filesystem::path source;
  const BakedMap& map;
  std::vector<FileRecord> files = {};  ///< the textures, in their order
  std::optional<FileRecord> report = {};
  nlohmann::ordered_json former = {};  ///< entries for maps of an earlier bake that stay
  std::vector<Warning> warnings;
  double output_seconds = 0;  ///< that writing the textures took
};

/// Writes NAME_bake.json: definition, unit, range, options and errors of each file. Throws Error naming it.
void write_sidecar(const std::filesystem::path& path, const BakeOptions& options,
                   const std::vector<BakedTexture>& textures, const SidecarFacts& facts);

}  // namespace heightlight
