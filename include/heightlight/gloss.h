#pragma once

#include <cstdint>

#include "heightlight/image.h"
#include "heightlight/surface.h"
#include "heightlight/watch.h"

// What a glossy surface sees of an even sky: specular occlusion (Jimenez 2016, eqs. 24 to 28),
//     S = ∫ V f_r cosθ dω ÷ ∫ f_r cosθ dω
// over the hemisphere of a receiver's normal, 1 where all is open. f_r is GGX's: the distribution of Walter
// et al. 2007 (eq. 33), Smith's shadowing of either direction (eqs. 23 and 34), and Schlick's form of
// Fresnel's factor.

namespace heightlight {

/// A glossy surface.
struct Gloss {
  double roughness = 0.13;    ///< α of GGX, in (0, 1]: the square of what many engines call by that name
  double reflectance = 0.04;  ///< at normal incidence, in [0, 1]; the paper's table is of 0.04
};

/// Throws UsageError for values outside their range.
void check_gloss(const Gloss& gloss);

/// Throws UsageError unless it is a direction from above: finite, z > 0. It need not be a unit vector.
void check_view(const Vector3& view);

/// How specular occlusion is found.
struct SpecularOptions {
  Gloss gloss = {};
  Vector3 view = {0, 0, 1};  ///< toward the viewer, who is far away; world axes, z > 0
  int rays = 256;            ///< per receiver, 16 … 65536, as the lobe sends light
  std::uint64_t seed = 1;
  Watch watch = {};
};

/// Of every texel.
struct SpecularOcclusion {
  Map occlusion;    ///< S in [0, 1]; NaN where the sample is missing, or faces away from the view
  double rmse = 0;  ///< expected of the texels, from how sixteen parts of each one's rays differ
};

/// Finds it by rays into the lobe, each of which stands for what its direction reflects into the view
/// (visible normals, Heitz 2018). In the open it is 1 to the last bit. Texels that something hides from the
/// viewer are found like others. The same to the last bit for any number of threads. Throws UsageError for
/// options outside their range, Cancelled when the watch says so.
SpecularOcclusion specular_occlusion(const Surface& surface, const SpecularOptions& options);

}  // namespace heightlight
