#include "bake/sidecar.h"

#include <nlohmann/json.hpp>
#include <numbers>

#include "bake/texel_encoding.h"
#include "base/texel_algebra.h"
#include "files/evidence_json.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "heightlight/version.h"

namespace heightlight {
namespace {

using Json = nlohmann::ordered_json;

const char* to_string(TextureDepth depth) {
  switch (depth) {
    case TextureDepth::uint8:
      return "8";
    case TextureDepth::uint16:
      return "16";
    case TextureDepth::half:
      return "half";
    case TextureDepth::real:
      return "float";
  }
  return "";
}

const char* to_string(Falloff falloff) {
  switch (falloff) {
    case Falloff::none:
      return "none";
    case Falloff::linear:
      return "linear";
    case Falloff::root:
      return "sqrt";
    case Falloff::exponential:
      return "exponential";
  }
  return "";
}

Json describe_channel(const BakedChannel& channel, TextureDepth depth) {
  Json json = {{"quantity", channel.quantity}, {"unit", channel.unit}};
  const int levels = largest_level(depth);
  if (levels == 0) return json;
  json["value_of_level_0"] = channel.low;
  json["value_of_level_" + std::to_string(levels)] = channel.high;
  json["missing_samples"] = channel.missing;
  if (channel.is_srgb) json["encoding"] = "sRGB, of the share between the two";
  return json;
}

Json describe_textures(const BakeOptions& options, const std::vector<BakedTexture>& textures,
                       const std::vector<FileRecord>& files) {
  Json list = Json::array();
  for (std::size_t i = 0; i < textures.size(); ++i) {
    Json channels = Json::array();
    for (const BakedChannel& channel : textures[i].channels) {
      channels.push_back(describe_channel(channel, options.depth));
    }
    Json file = describe_file(files[i]);
    file["definition"] = textures[i].definition;
    file["channels"] = channels;
    list.push_back(file);
  }
  if (options.draw_sheet) {
    list.push_back(describe_file(files.back()));
    list.back()["definition"] = "a picture of all, sRGB encoded: for the eye";
  }
  return list;
}

Json describe_conventions(const BakeOptions& options, const Heightmap& map) {
  const bool north = azimuth_convention(options, map.boundary) == AzimuthConvention::north;
  const bool ground = options.below == BelowHorizontal::ground;
  return {{"encoding", "linear"},
          {"depth", to_string(options.depth)},
          {"levels", largest_level(options.depth) == 0 ? Json(nullptr)
                     : options.dither                  ? Json("dithered by blue noise")
                                                       : Json("rounded to the nearest")},
          {"normal_y", options.y_down ? "directx (y down the picture)" : "opengl (y up the picture)"},
          {"axes", "x right, z out of the picture"},
          {"normal_strength", options.normal_strength},
          {"normal_is_physical", options.normal_strength == 1},
          {"azimuths", north ? "clockwise from north, up the picture" : "from x toward y"},
          {"below_horizontal", ground ? "ground: nothing there shines" : "sky, where no surface is"},
          {"rows", "from the top"}};
}

Json describe_maximum_distance(const BakeOptions& options) {
  if (!options.maximum_distance) return "unlimited";
  return {{"max_distance", options.maximum_distance->distance},
          {"falloff", to_string(options.maximum_distance->falloff)},
          {"applies_to",
           "ao, bent-normal, bent-cone, sh, svf-tilted, terrain-view-factor; horizon and all other "
           "definitions (without falloff)"},
          {"not_to", "multibounce, ao-n: bounces come from everywhere; specular-occlusion"}};
}

/// What each kind of map errs by; `visibility` says on what that was found.
Json describe_errors(const BakeOptions& options, const Material& material) {
  const Evidence& evidence = material.results.evidence;
  Json json;
  if (evidence.sky_check) {
    const SkyCheck& check = *evidence.sky_check;
    json["ao_rmse"] = options.uniform_ao ? check.ambient_occlusion : check.sky_view_factor;
    if (check.bent_normal_rad) {
      json["bent_normal_rmse_degrees"] = *check.bent_normal_rad * 180 / std::numbers::pi;
    }
    if (check.harmonics) json["sh_coefficient_rmse"] = *check.harmonics;
  }
  for (const DefinitionCheck& check : evidence.definition_checks) {
    const SkyDefinitionFacts& facts = facts_of(check.definition);
    if (check.rmse) json[std::string(facts.name) + "_rmse"] = *check.rmse;
  }
  if (is_wanted(options, MaterialMap::specular_occlusion))
    json["specular_occlusion_rmse"] = material.specular.rmse;
  if (is_wanted(options, MaterialMap::multibounce) && !evidence.total_checks.empty()) {
    json["multibounce_rmse"] = evidence.total_checks[0].total_rmse;
  }
  for (const ModelError& error : material.model_errors) {
    json["ao_n_rmse_against_simulation"].push_back({{"albedo", error.albedo},
                                                    {"unrounded", error.rmse},
                                                    {"16_bits", error.rmse_16_bits},
                                                    {"8_bits", error.rmse_8_bits}});
  }
  return json;
}

/// What an engine's material wants: displacement = (level / largest level − midlevel) × scale.
Json describe_displacement(const BakeOptions& options, double relief) {
  const auto [name, per_metre] = unit_of(options.displacement_unit);
  return {{"scale", relief * per_metre},
          {"midlevel", options.midlevel},
          {"unit", name},
          {"of", "world units as metres"}};
}

Json describe_albedo(const Albedo& albedo) {
  if (albedo.varying.empty()) return albedo.constant;
  Json means = Json::array();
  for (const TexelVector& values : albedo.varying) means.push_back(as_eigen(values).mean());
  return {{"mean_of_map", means}};
}

/// Files that packs took channels of.
Json describe_own(const std::vector<OwnChannel>& channels) {
  Json list = Json::array();
  for (const OwnChannel& own : channels)
    list.push_back({{"path", printable(own.path)},
                    {"sha256", own.sha256},
                    {"channel", own.channel.empty() ? Json(nullptr) : Json(own.channel)},
                    {"decoded_from", own.is_srgb ? "sRGB" : "linear"}});
  return list;
}

}  // namespace

void write_sidecar(const std::filesystem::path& path, const BakeOptions& options,
                   const std::vector<BakedTexture>& textures, const SidecarFacts& facts) {
  const Material& material = facts.map.material;
  const Evidence& evidence = material.results.evidence;
  Json json;
  json["version"] = HEIGHTLIGHT_VERSION;
  if (!options.request.empty()) json["request"] = options.request;
  if (!options.surface.empty()) json["surface"] = options.surface;
  json["map"] = describe_map(facts.source, facts.map.sha256, facts.map.header,
                             {.relief = facts.map.relief, .missing = facts.map.missing});
  if (!options.relief_from.empty()) json["map"]["relief_from"] = options.relief_from;
  json["files"] = describe_textures(options, textures, facts.files);
  if (facts.report) {
    Json report = describe_file(*facts.report);
    report["definition"] = "a page for browsers that shows the maps";
    report["channels"] = Json::array();
    json["files"].push_back(std::move(report));
  }
  for (const Json& entry : facts.former) json["files"].push_back(entry);
  if (!options.own.empty()) json["packed_from"] = describe_own(options.own);
  json["conventions"] = describe_conventions(options, facts.map.header);
  json["reach"] = describe_maximum_distance(options);
  if (is_wanted(options, MaterialMap::multibounce)) {
    json["albedo"] = describe_albedo(options.albedo);
    if (options.light_channels > 0) {
      json["light"] = {{"of", material.light.description}, {"direct_rmse", material.light.rmse}};
    }
    json["bounces"] = {
        {"gathered", evidence.bounces},
        {"then", "the rest, to convergence"},
        {"use",
         "colour = albedo * multibounce * the light of an open place, in linear numbers; all bounces are "
         "in it: not for what brightens AO again or bounces light once more"}};
  }
  if (is_wanted(options, MaterialMap::specular_occlusion))
    json["gloss"] = {{"roughness_ggx_alpha", options.gloss.roughness},
                     {"reflectance", options.gloss.reflectance},
                     {"view", {options.view.x, options.view.y, options.view.z}},
                     {"view_axes", "x right, y up the picture, z out of it"},
                     {"rays_per_texel", material.specular.rays}};
  if (material.local.scale > 0 || !material.local.curvature.values.empty())
    json["detail"] = {{"gaussian_standard_deviation", material.local.scale}};
  if (is_wanted(options, MaterialMap::displacement))
    json["displacement"] = describe_displacement(options, facts.map.relief);
  json.update(describe_evidence(evidence));
  json["errors"] = describe_errors(options, material);
  json["warnings"] = describe_warnings(facts.warnings);
  json["time_s"] = describe_times(evidence.seconds);
  json["time_s"]["output"] = facts.output_seconds;
  json["memory"] = describe_memory(evidence);
  json["threads"] = evidence.threads;
  write_bytes(path, json_text(json));
}

}  // namespace heightlight
