#include "cli/pack_options.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/pack_text.h"
#include "cli/preset.h"
#include "files/image_file.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

/// "roughness=rough.png:G" is given to the input of that name, or to a new one, for packs.
void give_file(const std::string& text, std::vector<PackInput>& inputs) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError("input", text, "write NAME=FILE, such as roughness=rough.png");
  const std::string name = text.substr(0, equals);
  FileText file = parse_file_text("input", text.substr(equals + 1));
  auto input =
      std::find_if(inputs.begin(), inputs.end(), [&](const PackInput& known) { return known.name == name; });
  if (input == inputs.end()) input = inputs.insert(inputs.end(), {.name = name});
  if (input->file) throw UsageError("input", text, "the input has a file already");
  input->file = std::move(file);
}

/// Nothing that was given may be left over.
void check_taken(const std::vector<PackInput>& inputs) {
  std::string known;
  for (const PackInput& input : inputs) {
    if (input.is_taken) known += (known.empty() ? "" : ", ") + input.name;
  }
  for (const PackInput& input : inputs) {
    if (input.is_taken || !input.file) continue;
    throw UsageError(
        "input", input.name,
        "is not used by any pack" + (known.empty() ? std::string() : " (packs take " + known + ")"));
  }
}

void set_default(std::string& text, const std::string& value) {
  if (text.empty()) text = value;
}

/// The packs of a preset's files, into which ao-n may go.
void add_preset_packs(const Preset& preset, PackSources& sources, BakeOptions& options) {
  const auto ao_n = std::find(options.maps.begin(), options.maps.end(), MaterialMap::ao_n);
  const bool wants_ao_n = ao_n != options.maps.end();
  bool is_packed = false;
  for (const PresetFile& file : preset.files) {
    const bool other = wants_ao_n && !file.with_ao_n.empty();
    is_packed = is_packed || other;
    PackedTexture pack = parse_pack(other ? file.with_ao_n : file.channels, sources);
    pack.name = file.map;
    pack.is_srgb = file.is_srgb;
    options.packed.push_back(std::move(pack));
  }
  if (is_packed) options.maps.erase(ao_n);
}

}  // namespace

void add_pack_options(CLI::App& app, PackOptions& options) {
  app.add_option("--format", options.format,
                 "file format: png (default for materials), exr, tif (default for terrain: a GeoTIFF at the "
                 "place of the map), or asc")
      ->check(CLI::IsMember({"png", "exr", "tif", "asc"}));
  app.add_option("--depth", options.depth,
                 "type of the stored values: 8 or 16 bits (default 16), half, or float (default for exr, asc "
                 "and the tif of terrain)")
      ->check(CLI::IsMember({"8", "16", "half", "float"}));
  app.add_option("--normal-y", options.normal_y,
                 "direction of y in all maps of directions; opengl: up the picture (default); directx: down "
                 "the picture")
      ->check(CLI::IsMember({"opengl", "directx"}));
  app.add_option("--pack", options.packs,
                 "also write a file whose channels come from maps and from your own files, such as "
                 "R=ao,G=rough.png,B=metal.png:R; NAME before a colon replaces 'packed' in the name of the "
                 "file; may be repeated")
      ->allow_extra_args(false)
      ->type_name("[NAME:]R=MAP|FILE,…");
  app.add_option("--preset", options.preset, "write the files that an engine expects; the list is below")
      ->type_name("NAME");
  app.add_option("--preset-file", options.preset_file, "JSON file with your own presets for --preset")
      ->type_name("FILE");
  app.add_option("--input", options.inputs,
                 "your own file for an input of a preset or a pack, such as roughness=rough.png:G:srgb; "
                 "{stem}, {material} and {folder} stand for those of the heightmap; may be repeated")
      ->allow_extra_args(false)
      ->type_name("NAME=FILE[:CHANNEL][:srgb]");
  app.add_option("--name", options.name,
                 "pattern of the names of files, with {stem}, {map} and {material}, which is the stem "
                 "without _height (default {stem}_{map})")
      ->type_name("TEXT");
}

void apply_pack_options(PackOptions& pack, BakeOptions& options) {
  PackSources sources;
  Preset preset;
  if (!pack.preset.empty()) {
    preset = read_preset(pack.preset, pack.preset_file);
    sources.inputs = preset.inputs;
    pack.preset_text = preset.text;
    set_default(pack.format, preset.format);
    set_default(pack.depth, preset.depth);
    set_default(pack.normal_y, preset.normal_y);
  } else if (!pack.preset_file.empty()) {
    throw UsageError("preset_file", "", "needs --preset with the name of one of its presets");
  }
  for (const std::string& input : pack.inputs) give_file(input, sources.inputs);
  add_preset_packs(preset, sources, options);
  for (const std::string& text : pack.packs) options.packed.push_back(parse_pack(text, sources));
  check_taken(sources.inputs);
  options.own = std::move(sources.own);
  options.name = pack.name.empty() ? preset.name : pack.name;
  options.y_down = pack.normal_y == "directx";
}

std::string pack_key(const PackOptions& pack, const BakeOptions& options) {
  nlohmann::ordered_json key;
  if (!pack.preset.empty()) key["preset"] = pack.preset_text;
  if (!pack.name.empty()) key["name"] = pack.name;
  if (!pack.inputs.empty()) key["inputs"] = pack.inputs;
  for (const OwnChannel& own : options.own) key["own"].push_back(own.sha256);
  return key.empty() ? "" : key.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace heightlight
