#include <cstdlib>
#include <optional>
#include <sstream>

#include "cli/albedo.h"
#include "cli/bake_command.h"
#include "cli/gloss_options.h"
#include "cli/reach_options.h"
#include "files/projection_text.h"
#include "files/terrain_file.h"
#include "heightlight/error.h"
#include "visibility/reach_table.h"

namespace heightlight {
namespace {

std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  if (text.ends_with(',')) parts.emplace_back();
  return parts;
}

MaterialMap parse_map(const std::string& option, const std::string& name) {
  std::string known;
  for (const MaterialMapName& entry : material_maps()) {
    if (name == entry.name) return entry.map;
    known += std::string(known.empty() ? "" : ", ") + entry.name;
  }
  throw UsageError(option, "", "'" + name + "' is no map (known: " + known + ")");
}

/// "ao", "bent-normal.x", "sh.8", or a constant in [0, 1].
PackedChannel parse_source(const std::string& text) {
  char* end = nullptr;
  const double constant = std::strtod(text.c_str(), &end);
  if (!text.empty() && *end == '\0') {
    if (!(constant >= 0 && constant <= 1)) throw UsageError("pack", "", text + " is not in [0, 1]");
    return {.map = std::nullopt, .constant = constant};
  }
  const std::size_t point = text.find('.');
  PackedChannel channel{.map = parse_map("pack", text.substr(0, point))};
  if (point == std::string::npos) return channel;
  const std::string component = text.substr(point + 1);
  const std::size_t letter = std::string("xyzwrgba").find(component);
  if (component.size() == 1 && letter != std::string::npos) {
    channel.component = static_cast<int>(letter % 4);
  } else if (!component.empty() && component.size() <= 3 &&
             component.find_first_not_of("0123456789") == std::string::npos) {
    channel.component = std::stoi(component);
  } else {
    throw UsageError("pack", "",
                     "'" + component + "' names no component (x, y, z, w, r, g, b, a, or a number from 0)");
  }
  return channel;
}

/// "R=ao,G=multibounce,B=0": channels without a source before one with are 0.
std::vector<PackedChannel> parse_packed(const std::string& text) {
  const std::string letters = "RGBA";
  std::vector<std::optional<PackedChannel>> given(4);
  std::size_t count = 0;
  for (const std::string& part : split_at_commas(text)) {
    const std::size_t channel = part.size() > 2 && part[1] == '=' ? letters.find(part[0]) : std::string::npos;
    if (channel == std::string::npos || given[channel]) {
      throw UsageError("pack", text, "write it like R=ao,G=multibounce,B=normal.z, each of R, G, B, A once");
    }
    given[channel] = parse_source(part.substr(2));
    count = std::max(count, channel + 1);
  }
  if (count == 2) count = 3;  // image viewers know no two channels
  std::vector<PackedChannel> packed;
  for (std::size_t i = 0; i < count; ++i) packed.push_back(given[i].value_or(PackedChannel{}));
  return packed;
}

TextureFormat parse_format(const std::string& text) {
  return text == "exr"   ? TextureFormat::exr
         : text == "tif" ? TextureFormat::tif
         : text == "asc" ? TextureFormat::asc
                         : TextureFormat::png;
}

TextureDepth parse_depth(const std::string& text, TextureFormat format, bool is_terrain) {
  if (text.empty()) {
    const bool is_real = format == TextureFormat::exr || format == TextureFormat::asc ||
                         (format == TextureFormat::tif && is_terrain);
    return is_real ? TextureDepth::real : TextureDepth::uint16;
  }
  return text == "8"      ? TextureDepth::uint8
         : text == "16"   ? TextureDepth::uint16
         : text == "half" ? TextureDepth::half
                          : TextureDepth::real;
}

}  // namespace

void parse_bake_options(BakeCommand& command) {
  BakeOptions& options = command.options;
  for (const std::string& name : split_at_commas(command.maps)) {
    options.maps.push_back(parse_map("maps", name));
  }
  options.packed = parse_packed(command.packed);
  if (options.maps.empty() && options.packed.empty()) {
    options.maps = {MaterialMap::ao, MaterialMap::normal, MaterialMap::bent_normal};
  }
  options.gloss.roughness = parse_roughness(command.roughness);
  options.view = parse_view(command.view);
  options.memory = command.run.memory;
  options.seed = command.run.seed;
  if (command.falloff != "none" && command.max_distance.empty()) {
    throw UsageError("falloff", "", "needs --max-distance, where it ends");
  }
  if (!command.max_distance.empty())
    check_reach({.distance = parse_distance("max_distance", command.max_distance, 1)});
  check_load_options(command.load);
  check_albedo(command.albedo);
  check_light_options(command.light);
}

BakeOptions options_for(const BakeCommand& command, const std::filesystem::path& map) {
  BakeOptions options = command.options;
  const bool terrain = is_loaded_as_terrain(command.load, map);
  options.format = command.format.empty() && terrain ? TextureFormat::tif : parse_format(command.format);
  options.depth = parse_depth(command.depth, options.format, terrain);
  if (has_own_light(command.light)) options.light_channels = count_light_channels(command.light);
  options.projection = read_projection_text(map);
  return options;
}

}  // namespace heightlight
