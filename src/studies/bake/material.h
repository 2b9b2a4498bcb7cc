#pragma once

#include <vector>

#include "bake/bake.h"
#include "bake/local_maps.h"
#include "bake/model_map.h"
#include "heightlight/solve.h"

namespace heightlight {

/// All that is known of a surface before its maps are written: one solution, from which every channel of
/// every map follows texel by texel.
struct Material {
  const Surface* surface = nullptr;
  Results results;             ///< the sky as far as the maximum distance; horizons in the axes of the files
  SpecularOcclusion specular;  ///< where it is wanted
  LocalMaps local;             ///< those that are wanted
  std::vector<Map> totals;     ///< E/π, per channel of the albedo or of the light
  GivenIrradiance light;       ///< without channels where it is an even sky's
  std::vector<ModelError> model_errors;
};

/// From where the azimuths of horizons count.
AzimuthConvention azimuth_convention(const BakeOptions& options, Boundary boundary);

/// Whether a map is to be found: to be written, alone or packed, or for the sheet.
bool is_wanted(const BakeOptions& options, MaterialMap map);

/// What solves for the wanted maps; `convention`: from where the azimuths of horizons count.
Request material_request(const BakeOptions& options, AzimuthConvention convention);

/// Finds what the wanted maps need, and nothing else. `surface` must outlive the result. Throws what solve
/// throws.
Material find_material(const Surface& surface, const BakeOptions& options);

}  // namespace heightlight
