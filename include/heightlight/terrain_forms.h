#pragma once

#include <functional>
#include <string>
#include <vector>

#include "heightlight/forms.h"
#include "heightlight/image.h"
#include "heightlight/surface.h"

// What energy-balance models and atmospheric corrections make of light that terrain reflects: irradiance of a
// texel from its direct irradiance, its sky view factor, and means over a window around it. All irradiances
// are E/π, in one unit of the caller's.

namespace heightlight {

/// Means over a window around a texel.
struct TerrainMeans {
  double albedo = 0;         ///< ρ_w, plain
  double direct = 0;         ///< E0_w, plain
  double surface_share = 0;  ///< V_w, of V = 1 − A, plain
  double configuration = 0;  ///< C_w, of C_t, plain
  double seen_direct = 0;    ///< D_w, of E₀, weighted by V/n_z: by how much of each place's area is seen
  double seen_sky = 1;       ///< A_w, of A, likewise
};

/// Everything that a terrain form may want to know of a texel.
struct TerrainInputs {
  double direct = 0;                         ///< E₀/π, of the sun, the sky or both
  double level = 0;                          ///< L, of a level open plane under the same light
  double albedo = 0;                         ///< ρ, here
  SkyViewFactor<double> sky_view_factor{1};  ///< A
  double configuration = 0;                  ///< C_t
  TerrainMeans window = {};
  SeenSkyViewFactor<double> expected_seen{1};  ///< s, one number per map
  SeenSkyViewFactor<double> deep_seen{1};      ///< t, one number per map
};

/// C_t = (1 + cos S)/2 − V_d, no less than 0 (Dozier and Frew 1990): the share of an infinite slope's sky, of
/// inclination S, that terrain hides. V_d is the cosine-weighted share of the slope's hemisphere that sees
/// sky above the horizontal. What lies below the horizontal is in neither, so that the slope down in the
/// valley counts as nothing that reflects; V = 1 − A counts it, where A lets light of below the horizontal
/// in, and terrain that is seen there as terrain.
double terrain_configuration(double slope_cosine, double upper_sky);

/// One form of the list.
struct TerrainForm {
  std::string name;         ///< as in tables, snake_case
  std::string description;  ///< the formula
  std::string source;
  bool wants_window = false;                                  ///< it takes means
  bool even_sky_only = false;                                 ///< it is for E₀ = A
  std::function<double(const TerrainInputs&)> evaluate = {};  ///< E/π with what terrain reflects
};

/// The list: E₀ alone, those of the literature, ours.
const std::vector<TerrainForm>& terrain_forms();

/// Σ w v/Σ w of values over a box of texels around each one, whose middles are no farther from its own than
/// `radius` ≥ 0 along either axis (world units); boxes end at open borders, and go around where the map
/// tiles. `weights` ≥ 0; a texel that is missing counts for nothing, whatever stands there, and gets 0, as
/// one does whose weights sum to 0. Throws UsageError for sizes other than the surface's and for a radius
/// that is negative or no number.
TexelVector window_mean(const Surface& surface, const TexelVector& values, const TexelVector& weights,
                        double radius);

}  // namespace heightlight
