#include <functional>

#include "bake/material.h"
#include "cli/albedo.h"
#include "cli/bake_command.h"
#include "cli/bake_report.h"
#include "cli/gloss_options.h"
#include "cli/map_list.h"
#include "cli/reach_options.h"
#include "files/image_file.h"
#include "files/projection_text.h"
#include "files/terrain_file.h"
#include "heightlight/error.h"
#include "plot/material_sheet.h"
#include "visibility/distance_table.h"

namespace heightlight {
namespace {

MaterialMap parse_map(const std::string& name) {
  if (const auto map = find_material_map(name)) return *map;
  throw UsageError("maps", "", "'" + name + "' is not a map (known: " + known_material_maps() + ")");
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

/// Draws the sheet of the map of that name.
std::function<Image<Rgb8>(const Material&, const Albedo&)> sheet_of(const std::string& name,
                                                                    const BakeOptions& options) {
  return [name, y_down = options.y_down](const Material& material, const Albedo& albedo) {
    return draw_material_sheet({.surface = *material.surface,
                                .occlusion = material.results.sky_view_factor,
                                .first_moment = material.results.moments.first,
                                .totals = material.totals,
                                .albedo = albedo,
                                .name = name,
                                .y_down = y_down});
  };
}

}  // namespace

void parse_bake_options(BakeCommand& command) {
  BakeOptions& options = command.options;
  for (const std::string& name : split_at_commas(command.maps)) {
    options.maps.push_back(parse_map(name));
  }
  apply_pack_options(command.pack, options);
  if (options.maps.empty() && options.packed.empty()) {
    options.maps = {MaterialMap::ao, MaterialMap::normal, MaterialMap::bent_normal};
  }
  options.gloss.roughness = parse_roughness(command.roughness);
  options.view = parse_view(command.view);
  options.memory = command.run.memory;
  options.seed = command.run.seed;
  if (command.falloff != "none" && command.max_distance.empty()) {
    throw UsageError("falloff", "", "needs --max-distance, at which it ends");
  }
  if (!command.max_distance.empty())
    check_maximum_distance({.distance = parse_distance("max_distance", command.max_distance, 1)});
  if (!command.detail_scale.empty())
    options.detail_scale = parse_distance("detail_scale", command.detail_scale, 1);
  if (!command.reliefs.empty()) command.relief_table = read_reliefs(command.reliefs);
  if (!command.match.empty()) command.match_sha256 = sha256_of_file(std::filesystem::path(command.match));
  check_load_options(command.load);
  check_albedo(command.albedo);
  check_light_options(command.light);
}

BakeCommand command_for(const BakeCommand& command, const std::filesystem::path& map) {
  BakeCommand own = command;
  const NamedRelief* named = find_relief(command.relief_table, map);
  if (!named) return own;
  own.load.relief = named->relief;
  if (named->width) own.load.width = named->width;
  return own;
}

BakeOptions options_for(const BakeCommand& command, const std::filesystem::path& map) {
  BakeOptions options = command.options;
  const bool terrain = is_loaded_as_terrain(command.load, map);
  const PackOptions& pack = command.pack;
  options.format = pack.format.empty() && terrain ? TextureFormat::tif : parse_format(pack.format);
  options.depth = parse_depth(pack.depth, options.format, terrain);
  options.own = own_channels_for(options, map);
  if (has_own_light(command.light)) options.light_channels = count_light_channels(command.light);
  options.projection = read_projection_text(map);
  options.relief_from = command.relief_from;
  if (command.report) {
    std::vector<std::filesystem::path> others = light_files(command.light);
    others.insert(others.begin(), {command.albedo, command.match});
    for (const OwnChannel& own : options.own) others.push_back(own.path);
    options.write_report = [others](const std::filesystem::path& path, const ReportedBake& bake) {
      write_bake_report(path, bake, others);
    };
  }
  if (command.sheet) options.draw_sheet = sheet_of(map.stem().string(), options);
  return options;
}

}  // namespace heightlight
