#include "terrain/sky_definitions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace heightlight {

const std::vector<SkyDefinitionText>& sky_definitions() {
  static const std::vector<SkyDefinitionText> texts = {
      {SkyDefinition::sky_view_factor, "sky_view_factor",
       "cosine weighted on the slope, down to its tangent plane"},
      {SkyDefinition::svf_tilted, "svf_tilted", "cosine weighted on the slope, dark below the horizontal"},
      {SkyDefinition::svf_horizontal, "svf_horizontal", "mean cos^2 h"},
      {SkyDefinition::svf_solid_angle, "svf_solid_angle", "1 - mean sin h"},
      {SkyDefinition::mean_cos_h, "mean_cos_h", "mean cos h"},
      {SkyDefinition::openness_positive, "openness_positive", "mean (pi/2 - h), radians"},
  };
  return texts;
}

const char* name_of(SkyDefinition definition) {
  return sky_definitions()[static_cast<std::size_t>(definition)].name;
}

void SkySum::add(SkyDefinition definition, const SliceNormal& normal, double horizon_slope) {
  const double raised = std::max(horizon_slope, 0.0);
  const double cosine = 1 / std::sqrt(1 + raised * raised);
  switch (definition) {
    case SkyDefinition::sky_view_factor:
    case SkyDefinition::svf_tilted: {
      const bool is_dark_below = definition == SkyDefinition::svf_tilted;
      const double tangent = tangent_slope(normal);
      const double lowest = std::max(tangent, is_dark_below ? raised : horizon_slope);
      open_ += cosine_mass(normal, elevation_of_slope(lowest), {});
      whole_ += cosine_mass(normal, elevation_of_slope(tangent), {});
      return;
    }
    case SkyDefinition::svf_horizontal:
      open_ += cosine * cosine;
      break;
    case SkyDefinition::svf_solid_angle:
      open_ += 1 - raised * cosine;
      break;
    case SkyDefinition::mean_cos_h:
      open_ += cosine;
      break;
    case SkyDefinition::openness_positive:
      open_ += std::numbers::pi / 2 - (std::isinf(horizon_slope) ? 0 : std::atan(horizon_slope));
      break;
  }
  whole_ += 1;
}

}  // namespace heightlight
