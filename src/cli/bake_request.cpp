#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "bake/baked_map.h"
#include "bake/material.h"
#include "cli/bake_command.h"
#include "cli/request.h"
#include "files/file_record.h"
#include "files/image_file.h"
#include "files/json_file.h"
#include "heightlight/version.h"

namespace heightlight {
namespace {

/// How the file becomes heights: of a relief that is to be found, what it is found by.
nlohmann::ordered_json describe_heights(const BakeCommand& command) {
  LoadOptions load = command.load;
  if (!command.match.empty()) load.relief.reset();
  nlohmann::ordered_json described = describe_load_options(load);
  if (!command.match.empty()) described["match"] = command.match_sha256;
  return described;
}

}  // namespace

std::string request_of(const BakeCommand& command, const BakeOptions& options, const std::string& map_sha256,
                       const std::string& albedo_sha256) {
  nlohmann::ordered_json request = {{"version", HEIGHTLIGHT_VERSION},
                                    {"map", map_sha256},
                                    {"load", describe_heights(command)},
                                    {"maps", command.maps},
                                    {"pack", fmt::format("{}", fmt::join(command.pack.packs, " "))},
                                    {"albedo", albedo_sha256.empty() ? command.albedo : albedo_sha256},
                                    {"max_distance", command.max_distance},
                                    {"falloff", command.falloff},
                                    {"uniform_ao", options.uniform_ao},
                                    {"depth", static_cast<int>(options.depth)},
                                    {"format", static_cast<int>(options.format)},
                                    {"y_down", options.y_down},
                                    {"bent_length", options.bent_length},
                                    {"dither", options.dither},
                                    {"horizon_azimuths", options.horizon_azimuths},
                                    {"error", options.error},
                                    {"azimuths", options.azimuths},
                                    {"seed", options.seed}};
  // Only where they are given: what was baked before there were such options stays.
  if (options.below == BelowHorizontal::ground) request["below_horizontal"] = "ground";
  if (is_wanted(options, MaterialMap::specular_occlusion))
    request["gloss"] = command.roughness + ' ' + command.view;
  if (const std::string pack = pack_key(command.pack, options); !pack.empty()) request["packing"] = pack;
  if (command.sheet) request["sheet"] = true;
  if (options.normal_strength != 1) request["normal_strength"] = options.normal_strength;
  if (!command.detail_scale.empty()) request["detail_scale"] = command.detail_scale;
  if (is_wanted(options, MaterialMap::displacement))
    request["displacement"] = {static_cast<int>(options.displacement_unit), options.midlevel};
  if (options.azimuth_convention)
    request["azimuth_convention"] = static_cast<int>(*options.azimuth_convention);
  if (!options.projection.empty()) request["projection"] = options.projection;
  if (!command.window.empty()) request["window"] = command.window;
  if (const std::string light = light_key(command.light); !light.empty()) request["light"] = light;
  return request_key(request);
}

std::string surface_of(const BakeCommand& command, const BakeOptions& options,
                       const std::string& map_sha256) {
  nlohmann::ordered_json surface = {
      {"version", HEIGHTLIGHT_VERSION}, {"map", map_sha256}, {"load", describe_heights(command)}};
  if (!options.projection.empty()) surface["projection"] = options.projection;
  return request_key(surface);
}

bool is_baked(const BakeCommand& command, const BakeInput& input) {
  BakeOptions options = options_for(command, input.path);
  const std::vector<std::string> names = baked_files(input.name, options);
  const std::filesystem::path sidecar = command.folder / names.back();
  std::error_code ignored;
  const bool all_there = std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    return std::filesystem::is_regular_file(command.folder / name, ignored);
  });
  if (!all_there) return false;
  find_checksums(options.own);
  const bool albedo_file = std::filesystem::is_regular_file(command.albedo, ignored);
  const std::string wanted =
      request_of(command, options, sha256_of_file(input.path),
                 albedo_file ? sha256_of_file(std::filesystem::path(command.albedo)) : "");
  try {
    const nlohmann::json json = read_json(sidecar);
    const auto files = parse_file_records(json);
    if (!files || !json.contains("request") || json["request"] != wanted) return false;
    if (files->size() < texture_suffixes(options).size()) return false;
    return std::all_of(files->begin(), files->end(),
                       [&](const FileRecord& file) { return is_as_recorded(command.folder, file); });
  } catch (const Cancelled&) {
    throw;
  } catch (const Error&) {
    return false;  // damaged from outside: baked again
  }
}

}  // namespace heightlight
