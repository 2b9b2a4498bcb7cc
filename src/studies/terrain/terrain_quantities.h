#pragma once

#include <string>
#include <vector>

#include "heightlight/visibility.h"

namespace heightlight {

/// What terrain tools call a sky view factor, or openness, and what they take to lie below the horizontal.
struct TerrainQuantity {
  SkyDefinition definition = SkyDefinition::svf_tilted;
  BelowHorizontal below = BelowHorizontal::sky;  ///< of svf_tilted alone: others have their own

  bool operator==(const TerrainQuantity&) const = default;
};

/// Those that methods are compared by.
const std::vector<TerrainQuantity>& terrain_quantities();

/// "svf-tilted", or "svf-tilted, dark below"
std::string name_of(const TerrainQuantity& quantity);

/// Its formula in words.
std::string formula_of(const TerrainQuantity& quantity);

}  // namespace heightlight
