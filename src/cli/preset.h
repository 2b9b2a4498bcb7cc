#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/pack_text.h"

namespace heightlight {

/// A file of a preset.
struct PresetFile {
  std::string map;             ///< what {map} stands for
  std::string channels;        ///< of a pack: "R=ao,G=roughness"
  std::string with_ao_n = {};  ///< the same where ao-n is wanted, which then is here alone; empty: no other
  bool is_srgb = false;        ///< encoded so
};

/// A set of files as an engine has them. Its text is in JSON: docs/packing.md describes it.
struct Preset {
  std::string name = "{stem}_{map}";  ///< of files
  std::string normal_y = "opengl";
  std::string format = "png";
  std::string depth = {};              ///< empty: as the command has it
  std::vector<PackInput> inputs = {};  ///< with what stands in for them
  std::vector<PresetFile> files = {};
  std::string text = {};  ///< all of it as JSON: another text is another preset
};

/// The preset of that name: of the file, where one is given and has it, else one that the program brings.
/// Throws UsageError for a name that neither has, Error naming the file and the place where it is damaged.
Preset read_preset(const std::string& name, const std::filesystem::path& file);

/// A line for each that the program brings: its name and what it is for.
std::string describe_presets();

}  // namespace heightlight
