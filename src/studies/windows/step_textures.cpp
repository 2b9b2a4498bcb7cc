#include "bake/baked_map.h"
#include "bake/material.h"
#include "base/texels.h"
#include "visibility/horizon_sky.h"
#include "windows/sky_maps.h"
#include "windows/steps.h"

namespace heightlight {
namespace {

/// What a window's textures are made of; `surface` must outlive it.
Material material_of_window(const Work& work, int window, const Surface& surface) {
  const BakeOptions& options = work.task.options;
  Material material;
  material.surface = &surface;
  std::vector<Map> maps;
  for (int k = 0; k < kept_sky_count(sky_wanted(options)); ++k)
    maps.push_back(read_window(sky_folder(work), window, k));
  HorizonSky sky = sky_of_maps(std::move(maps), options);
  material.results.sky_view_factor = std::move(sky.sky_view_factor);
  material.results.ambient_occlusion = std::move(sky.ambient_occlusion);
  material.results.moments = std::move(sky.moments);
  for (std::size_t c = 0; c < total_channels(work); ++c) {
    const StoredPlace total = total_place(work, c);
    material.totals.push_back(read_window(total.folder, window, total.k));
  }
  const Request request = material_request(options, azimuth_convention(options, surface.map.boundary));
  if (!request.wanted.horizon_rad.empty()) {
    material.results.horizons =
        walk_horizons(surface, {}, work.state.plan->sky.walk, request.wanted.horizon_rad,
                      options.maximum_distance, options.watch);
  }
  return material;
}

Map values_of(const BakedChannel& channel, const Surface& surface) {
  Map map(surface.width(), surface.height());
  for_texels(map, [&](std::size_t i) { map.values[i] = channel.value(i); });
  return map;
}

}  // namespace

void find_window_textures(Work& work, int window) {
  const Surface surface = surface_of_window(work, window, {work.state.plan->sky.walk});
  const Material material = material_of_window(work, window, surface);
  std::vector<Map> maps;
  std::vector<const Map*> written;
  for (const BakedTexture& texture : baked_textures(material, work.task.options)) {
    for (const BakedChannel& channel : texture.channels) maps.push_back(values_of(channel, surface));
  }
  for (const Map& map : maps) written.push_back(&map);
  write_window(textures_folder(work), window, written);
}

}  // namespace heightlight
