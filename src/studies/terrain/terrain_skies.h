#pragma once

#include <vector>

#include "visibility/slice_integrals.h"

namespace heightlight {

/// What terrain tools call a sky view factor, or openness, of the horizons h around a receiver.
enum class TerrainSky {
  sky_view_factor,    ///< A: cosine weighted on the slope, down to its tangent plane, as light has it
  svf_tilted,         ///< the same, with all that lies below the horizontal dark: V_d
  svf_horizontal,     ///< cosine weighted on a level receiver: mean cos² h
  svf_solid_angle,    ///< of the upper half of the sphere's solid angle: 1 − mean sin h
  mean_cos_h,         ///< mean cos h
  openness_positive,  ///< mean zenith angle of the horizon, π/2 − h, radians
};

/// How tables name one, and its formula in words.
struct TerrainSkyText {
  TerrainSky definition;
  const char* name;
  const char* formula;
};

/// All of them, in that order.
const std::vector<TerrainSkyText>& terrain_skies();
const char* name_of(TerrainSky definition);

/// The mean over a receiver's azimuths. A horizon is given by its slope, rise over way, −∞ where there is no
/// surface. Below the horizontal it is taken to be level, but for A and the openness; where there is no
/// surface at all, which says nothing, also for the openness.
class SkySum {
 public:
  void add(TerrainSky definition, const SliceNormal& normal, double horizon_slope);
  double value() const { return open_ / whole_; }

 private:
  double open_ = 0;
  double whole_ = 0;
};

}  // namespace heightlight
