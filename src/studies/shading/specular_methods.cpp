#include "shading/specular_methods.h"

#include <fmt/core.h>

#include <cmath>

namespace heightlight {
namespace {

SpecularMethod horizon_method(std::size_t count, int samples, bool shown) {
  return {.name = fmt::format("{} horizons, {} directions", count, samples),
          .takes_openness = false,
          .shown = shown,
          .occlusion = [count, samples](const GlossyTexel& texel) {
            const double* slopes = count == kStoredHorizons ? texel.horizons16 : texel.horizons8;
            return horizon_occlusion(texel.normal, texel.view, texel.roughness,
                                     StoredHorizons<double>(slopes, count), samples);
          }};
}

SpecularMethod polygon_method(std::size_t count) {
  return {.name = fmt::format("{} horizons, closed form", count),
          .takes_openness = false,
          .occlusion = [count](const GlossyTexel& texel) {
            const double* slopes = count == kStoredHorizons ? texel.horizons16 : texel.horizons8;
            return horizon_polygon_occlusion(texel.normal, texel.view, texel.roughness,
                                             StoredHorizons<double>(slopes, count));
          }};
}

SpecularMethod table_method(const NamedTable& named, bool shown) {
  return {.name = named.name, .shown = shown, .occlusion = [&table = named.table](const GlossyTexel& texel) {
            return look_up(table,
                           {.half_angle = angle_of_cosine(cone_cosine(SkyViewFactor{texel.sky_view_factor})),
                            .apart = texel.apart,
                            .roughness = texel.roughness,
                            .view_angle = angle_of_cosine(texel.view_cosine)});
          }};
}

SpecularMethod cone_method(const std::string& name, double share) {
  return {.name = name, .occlusion = [share](const GlossyTexel& texel) {
            return cone_cone_occlusion(SkyViewFactor{texel.sky_view_factor}, texel.apart, texel.roughness,
                                       {share});
          }};
}

}  // namespace

GlossyTexel make_glossy_texel(const Direction<double>& normal, const Direction<double>& view,
                              double sky_view_factor, const Direction<double>& bent_normal) {
  const double cosine = dot(normal, view);
  const Direction<double> mirrored{2 * cosine * normal.x - view.x, 2 * cosine * normal.y - view.y,
                                   2 * cosine * normal.z - view.z};
  return {.normal = normal,
          .view = view,
          .sky_view_factor = sky_view_factor,
          .view_cosine = cosine,
          .apart = angle_of_cosine(dot(bent_normal, mirrored))};
}

std::vector<SpecularMethod> specular_methods(const std::vector<NamedTable>& tables, double fitted_share) {
  std::vector<SpecularMethod> methods{
      {.name = "none", .takes_openness = false, .occlusion = [](const GlossyTexel&) { return 1.0; }},
      {.name = "AO",
       .shown = true,
       .occlusion = [](const GlossyTexel& texel) { return texel.sky_view_factor; }},
      {.name = "Lagarde",
       .shown = true,
       .occlusion =
           [](const GlossyTexel& texel) {
             return lagarde_occlusion(SkyViewFactor{texel.sky_view_factor}, texel.view_cosine,
                                      texel.roughness);
           }},
      cone_method("cone-cone, u 0.01", LobeConeConstants{}.share),
      cone_method(kFittedConeCone, fitted_share)};
  for (const NamedTable& table : tables) methods.push_back(table_method(table, &table == &tables.front()));
  methods[4].shown = true;
  methods.push_back(polygon_method(8));
  methods.push_back(polygon_method(kStoredHorizons));
  methods.push_back(horizon_method(8, 16, false));
  methods.push_back(horizon_method(8, 32, false));
  methods.push_back(horizon_method(kStoredHorizons, kHorizonSamples, true));
  methods.push_back(horizon_method(kStoredHorizons, 32, false));
  return methods;
}

}  // namespace heightlight
