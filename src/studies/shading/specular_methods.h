#pragma once

#include <functional>
#include <string>
#include <vector>

#include "heightlight/gloss.h"
#include "heightlight/occlusion_forms.h"

namespace heightlight {

/// Azimuths of the horizons that receivers have stored.
constexpr std::size_t kStoredHorizons = 16;

/// A table of GTSO, and what reports call its method.
struct NamedTable {
  std::string name;
  SpecularTable table;
};

/// All that a shader may know of a texel, for specular occlusion.
struct GlossyTexel {
  Direction<double> normal, view;  ///< unit, n·v > 0
  double roughness = 0.13;
  double sky_view_factor = 1;
  double view_cosine = 1;              ///< n·v
  double apart = 0;                    ///< between bent normal and mirrored view, rad
  const double* horizons16 = nullptr;  ///< slopes, as StoredHorizons has them
  const double* horizons8 = nullptr;
};

/// Of one texel.
GlossyTexel make_glossy_texel(const Direction<double>& normal, const Direction<double>& view,
                              double sky_view_factor, const Direction<double>& bent_normal);

/// A way to guess specular occlusion.
struct SpecularMethod {
  std::string name = {};
  bool takes_openness = true;  ///< A or the bent normal; false: its result is the same whoever finds those
  bool shown = false;          ///< in pictures
  std::function<double(const GlossyTexel&)> occlusion = {};
};

/// Names that reports look for.
inline constexpr const char* kFittedConeCone = "cone-cone, u fitted here";

/// All that are compared, with tables of GTSO, which must outlive them, and the u of cone against cone as it
/// was fitted to the map.
std::vector<SpecularMethod> specular_methods(const std::vector<NamedTable>& tables, double fitted_share);

}  // namespace heightlight
