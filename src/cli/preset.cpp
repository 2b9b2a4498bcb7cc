#include "cli/preset.h"

#include <nlohmann/json.hpp>

#include "cli/engine_presets.h"
#include "cli/json_place.h"
#include "files/json_file.h"
#include "files/printable.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

const nlohmann::json& built_in() {
  static const nlohmann::json presets = nlohmann::json::parse(kEnginePresets);
  return presets;
}

std::string one_of(const JsonPlace& place, const std::vector<std::string>& known) {
  std::string text = place.text();
  std::string list;
  for (const std::string& word : known) {
    if (word == text) return text;
    list += (list.empty() ? "\"" : ", \"") + word + "\"";
  }
  throw place.error("\"" + text + "\" is not allowed here; use one of " + list);
}

PackInput read_input(const std::string& name, const JsonPlace& stand_in) {
  const double value = stand_in.number();
  if (value < 0 || value > 1) throw stand_in.error("must be from 0 to 1");
  return {.name = name, .stand_in = value};
}

/// The text of a pack, which must be one, for these inputs.
std::string read_channels(const JsonPlace& place, const std::vector<PackInput>& inputs) {
  std::string text = place.text();
  try {
    PackSources sources{.inputs = inputs};
    parse_pack(text, sources);
  } catch (const UsageError& error) {
    throw place.error(error.what());
  }
  return text;
}

PresetFile read_file(const JsonPlace& place, const std::vector<PackInput>& inputs) {
  place.check_keys({"map", "channels", "with_ao_n", "encoding"});
  const auto map = place.find("map");
  const auto channels = place.find("channels");
  if (!map || !channels) throw place.error("must have a \"map\", which names it, and \"channels\"");
  PresetFile file{.map = map->text(), .channels = read_channels(*channels, inputs)};
  if (const auto other = place.find("with_ao_n")) file.with_ao_n = read_channels(*other, inputs);
  if (const auto encoding = place.find("encoding"))
    file.is_srgb = one_of(*encoding, {"linear", "srgb"}) == "srgb";
  return file;
}

Preset read(const JsonPlace& place) {
  place.check_keys({"about", "source", "name", "normal_y", "format", "depth", "inputs", "files"});
  Preset preset;
  for (const char* text : {"about", "source"}) {
    if (const auto told = place.find(text)) told->text();
  }
  if (const auto name = place.find("name")) preset.name = name->text();
  if (const auto y = place.find("normal_y")) preset.normal_y = one_of(*y, {"opengl", "directx"});
  if (const auto format = place.find("format")) preset.format = one_of(*format, {"png", "exr", "tif"});
  if (const auto depth = place.find("depth")) preset.depth = one_of(*depth, {"8", "16", "half", "float"});
  if (const auto inputs = place.find("inputs")) {
    for (const std::string& name : inputs->keys())
      preset.inputs.push_back(read_input(name, *inputs->find(name)));
  }
  const auto files = place.find("files");
  if (!files) throw place.error("must have \"files\"");
  for (const JsonPlace& file : files->items()) preset.files.push_back(read_file(file, preset.inputs));
  return preset;
}

std::string names_of(const nlohmann::json& presets) {
  std::string names;
  for (const auto& [name, ignored] : presets.items()) names += (names.empty() ? "" : ", ") + printable(name);
  return names;
}

/// The preset of that name, if it is among these.
std::optional<Preset> find_preset(const std::string& name, const nlohmann::json& presets,
                                  const std::filesystem::path& file) {
  const JsonPlace all(presets, file);
  const std::vector<std::string> ignored = all.keys();  // which an object has
  const auto found = all.find(name);
  if (!found) return std::nullopt;
  Preset preset = read(*found);
  preset.text = presets[name].dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return preset;
}

}  // namespace

Preset read_preset(const std::string& name, const std::filesystem::path& file) {
  std::string known = names_of(built_in());
  if (!file.empty()) {
    const nlohmann::json own = read_json(file);
    if (auto preset = find_preset(name, own, file)) return *preset;
    known += "; of " + file.string() + ": " + names_of(own);
  }
  if (auto preset = find_preset(name, built_in(), "presets/engines.json")) return *preset;
  throw UsageError("preset", name, "is not known (known: " + known + ")");
}

std::string describe_presets() {
  std::string text = "Presets:\n";
  for (const auto& [name, preset] : built_in().items())
    text += "  " + name + std::string(21 - name.size(), ' ') + preset["about"].get<std::string>() + "\n";
  return text;
}

}  // namespace heightlight
