#include "bake/bake.h"

namespace heightlight {
namespace {

std::vector<MaterialMapName> with_definitions(std::vector<MaterialMapName> maps) {
  for (const SkyDefinitionFacts& facts : sky_definitions())
    maps.push_back({static_cast<MaterialMap>(maps.size()), facts.name, facts.formula});
  return maps;
}

}  // namespace

const std::vector<MaterialMapName>& material_maps() {
  static const std::vector<MaterialMapName> kMaps = with_definitions(
      {{MaterialMap::ao, "ao", "ambient occlusion, 1 = open"},
       {MaterialMap::multibounce, "multibounce",
        "irradiance of all bounces at --albedo, 1 = unoccluded; multiply it in once, without ao"},
       {MaterialMap::direct, "direct", "direct irradiance of --sun, --sky or --direct, before any bounce"},
       {MaterialMap::bent_normal, "bent-normal", "mean direction of the visible sky"},
       {MaterialMap::bent_cone, "bent-cone",
        "bent normal, with the half-angle of the cone of visible sky in alpha"},
       {MaterialMap::normal, "normal", "normal of the surface"},
       {MaterialMap::ao_n, "ao-n", "two channels that give multibounce at any albedo, with a shader"},
       {MaterialMap::horizon, "horizon", "elevation of the horizon toward --horizon-azimuths azimuths"},
       {MaterialMap::sh, "sh", "order-2 spherical harmonics of cosine-weighted visibility"},
       {MaterialMap::height, "height", "heights from 0 to 1"},
       {MaterialMap::specular_occlusion, "specular-occlusion",
        "fraction of a glossy lobe that sees the sky, at --roughness from --view; with shaders and the table "
        "of GTSO"},
       {MaterialMap::curvature, "curvature",
        "mean curvature at --detail-scale: 0.5 is flat, larger values are convex"},
       {MaterialMap::convexity, "convexity",
        "convex part of curvature; 0 where the surface is flat or concave"},
       {MaterialMap::concavity, "concavity",
        "concave part of curvature; 0 where the surface is flat or convex"},
       {MaterialMap::cavity, "cavity",
        "height relative to the surroundings at --detail-scale; crevices are dark"},
       {MaterialMap::displacement, "displacement", "height above --midlevel, in metres or centimetres"}});
  return kMaps;
}

std::optional<SkyDefinition> definition_of(MaterialMap map) {
  if (map < MaterialMap::svf_tilted) return std::nullopt;
  return static_cast<SkyDefinition>(static_cast<int>(map) - static_cast<int>(MaterialMap::svf_tilted));
}

const char* to_string(MaterialMap map) { return material_maps()[static_cast<std::size_t>(map)].name; }

}  // namespace heightlight
