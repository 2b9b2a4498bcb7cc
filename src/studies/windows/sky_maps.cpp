#include "windows/sky_maps.h"

#include <cassert>

#include "bake/material.h"

namespace heightlight {
namespace {

Map component(const Image<Vector3>& vectors, float Vector3::*part) {
  Map map(vectors.width, vectors.height);
  for (std::size_t i = 0; i < map.size(); ++i) map.values[i] = vectors.values[i].*part;
  return map;
}

constexpr float Vector3::*kParts[] = {&Vector3::x, &Vector3::y, &Vector3::z};

}  // namespace

SkyWanted sky_wanted(const BakeOptions& options) {
  return material_request(options, AzimuthConvention::math).wanted.moments;
}

std::vector<Map> kept_sky_maps(const HorizonSky& sky, const BakeOptions& options) {
  const SkyWanted wanted = sky_wanted(options);
  std::vector<Map> maps{sky.sky_view_factor, sky.ambient_occlusion};
  for (std::size_t k = 0; wanted.first && k < 3; ++k) maps.push_back(component(sky.moments.first, kParts[k]));
  for (std::size_t k = 0; wanted.second && k < 5; ++k) {
    Map& map = maps.emplace_back(sky.sky_view_factor.width, sky.sky_view_factor.height);
    for (std::size_t i = 0; i < map.size(); ++i) map.values[i] = sky.moments.second.values[i][k];
  }
  return maps;
}

HorizonSky sky_of_maps(std::vector<Map> maps, const BakeOptions& options) {
  const SkyWanted wanted = sky_wanted(options);
  HorizonSky sky{
      .ambient_occlusion = std::move(maps[1]), .sky_view_factor = std::move(maps[0]), .moments = {}};
  const int width = sky.sky_view_factor.width;
  const int height = sky.sky_view_factor.height;
  if (wanted.first) sky.moments.first = Image<Vector3>(width, height);
  for (std::size_t k = 0; wanted.first && k < 3; ++k) {
    for (std::size_t i = 0; i < maps[2 + k].size(); ++i)
      sky.moments.first.values[i].*kParts[k] = maps[2 + k].values[i];
  }
  if (wanted.second) sky.moments.second = Image<std::array<float, 5>>(width, height);
  for (std::size_t k = 0; wanted.second && k < 5; ++k) {
    for (std::size_t i = 0; i < maps[5 + k].size(); ++i)
      sky.moments.second.values[i][k] = maps[5 + k].values[i];
  }
  return sky;
}

}  // namespace heightlight
