#include "terrain/terrain_skies.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace heightlight {

const std::vector<TerrainSkyText>& terrain_skies() {
  static const std::vector<TerrainSkyText> texts = {
      {TerrainSky::sky_view_factor, "sky_view_factor",
       "cosine weighted on the slope, down to its tangent plane"},
      {TerrainSky::svf_tilted, "svf_tilted", "cosine weighted on the slope, dark below the horizontal"},
      {TerrainSky::svf_horizontal, "svf_horizontal", "mean cos^2 h"},
      {TerrainSky::svf_solid_angle, "svf_solid_angle", "1 - mean sin h"},
      {TerrainSky::mean_cos_h, "mean_cos_h", "mean cos h"},
      {TerrainSky::openness_positive, "openness_positive", "mean (pi/2 - h), radians"},
  };
  return texts;
}

const char* name_of(TerrainSky definition) {
  return terrain_skies()[static_cast<std::size_t>(definition)].name;
}

void SkySum::add(TerrainSky definition, const SliceNormal& normal, double horizon_slope) {
  const double raised = std::max(horizon_slope, 0.0);
  const double cosine = 1 / std::sqrt(1 + raised * raised);
  switch (definition) {
    case TerrainSky::sky_view_factor:
    case TerrainSky::svf_tilted: {
      const bool is_dark_below = definition == TerrainSky::svf_tilted;
      const double tangent = tangent_slope(normal);
      const double lowest = std::max(tangent, is_dark_below ? raised : horizon_slope);
      open_ += cosine_mass(normal, elevation_of_slope(lowest), {});
      whole_ += cosine_mass(normal, elevation_of_slope(tangent), {});
      return;
    }
    case TerrainSky::svf_horizontal:
      open_ += cosine * cosine;
      break;
    case TerrainSky::svf_solid_angle:
      open_ += 1 - raised * cosine;
      break;
    case TerrainSky::mean_cos_h:
      open_ += cosine;
      break;
    case TerrainSky::openness_positive:
      open_ += std::numbers::pi / 2 - (std::isinf(horizon_slope) ? 0 : std::atan(horizon_slope));
      break;
  }
  whole_ += 1;
}

}  // namespace heightlight
