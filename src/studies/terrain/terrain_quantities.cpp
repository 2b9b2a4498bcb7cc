#include "terrain/terrain_quantities.h"

namespace heightlight {

const std::vector<TerrainQuantity>& terrain_quantities() {
  static const std::vector<TerrainQuantity> kQuantities{
      {.definition = SkyDefinition::svf_tilted, .below = BelowHorizontal::sky},
      {.definition = SkyDefinition::svf_tilted, .below = BelowHorizontal::ground},
      {.definition = SkyDefinition::svf_horizontal},
      {.definition = SkyDefinition::svf_solid_angle},
      {.definition = SkyDefinition::mean_cos_h},
      {.definition = SkyDefinition::openness_positive}};
  return kQuantities;
}

std::string name_of(const TerrainQuantity& quantity) {
  const std::string name = facts_of(quantity.definition).name;
  return quantity.below == BelowHorizontal::ground ? name + ", dark below" : name;
}

std::string formula_of(const TerrainQuantity& quantity) {
  const std::string formula = facts_of(quantity.definition).formula;
  return quantity.below == BelowHorizontal::ground ? formula + "; V = 0 below the horizontal" : formula;
}

}  // namespace heightlight
