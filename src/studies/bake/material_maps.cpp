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
        "irradiance of all bounces at the albedo, 1 = unoccluded: to be multiplied, once"},
       {MaterialMap::direct, "direct", "direct irradiance of --sun, --sky or --direct, before any bounce"},
       {MaterialMap::bent_normal, "bent-normal", "mean direction of the sky that is seen"},
       {MaterialMap::bent_cone, "bent-cone", "the same, with the half-angle of a cone in alpha"},
       {MaterialMap::normal, "normal", "normal of the surface"},
       {MaterialMap::ao_n, "ao-n", "two channels that give multibounce at any albedo, with a shader"},
       {MaterialMap::horizon, "horizon", "elevation of the horizon toward some azimuths"},
       {MaterialMap::sh, "sh", "order-2 spherical harmonics of cosine-weighted visibility"},
       {MaterialMap::height, "height", "heights from 0 to 1"},
       {MaterialMap::specular_occlusion, "specular-occlusion",
        "what gloss sees of the sky, at --roughness from --view, with shaders and GTSO's table"},
       {MaterialMap::curvature, "curvature", "mean curvature at --detail-scale: .5 flat, above it convex"},
       {MaterialMap::convexity, "convexity", "what of it is convex: 0 where it is not"},
       {MaterialMap::concavity, "concavity", "what of it is concave: 0 where it is not"},
       {MaterialMap::cavity, "cavity", "height above its surroundings at --detail-scale: crevices are dark"},
       {MaterialMap::displacement, "displacement", "height above --midlevel, in metres or centimetres"}});
  return kMaps;
}

std::optional<SkyDefinition> definition_of(MaterialMap map) {
  if (map < MaterialMap::svf_tilted) return std::nullopt;
  return static_cast<SkyDefinition>(static_cast<int>(map) - static_cast<int>(MaterialMap::svf_tilted));
}

const char* to_string(MaterialMap map) { return material_maps()[static_cast<std::size_t>(map)].name; }

}  // namespace heightlight
