#pragma once

#include <cstdint>
#include <vector>

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
  int rays = 256;        ///< per receiver, 16 … 65536, as the lobe sends light; 0: as many as `error` wants
  double error = 0.002;  ///< RMSE wanted, where rays is 0
  std::uint64_t seed = 1;
  Watch watch = {};
};

/// Of every texel.
struct SpecularOcclusion {
  Map occlusion;    ///< S in [0, 1]; NaN where the sample is missing, or faces away from the view
  double rmse = 0;  ///< expected of the texels, from how sixteen parts of each one's rays differ
  int rays = 0;     ///< per receiver, as they were in the end
};

/// Finds it by rays into the lobe, each of which stands for what its direction reflects into the view
/// (visible normals, Heitz 2018). In the open it is 1 to the last bit. Texels that something hides from the
/// viewer are found like others. Where an error is wanted, rays are multiplied until it is kept, or the most
/// is reached. The same to the last bit for any number of threads. Throws UsageError for options outside
/// their range, Cancelled when the watch says so.
SpecularOcclusion specular_occlusion(const Surface& surface, const SpecularOptions& options);

/// Where in the table of GTSO something stands (Jimenez 2016, eq. 30): a cone that stands for what is open,
/// and a lobe.
struct ConeArguments {
  double half_angle = 0;  ///< α_v of the cone, rad, in [0, π/2]; cone_cosine (occlusion_forms.h) of A
  double apart = 0;       ///< β between its axis, the bent normal, and the mirrored view, rad, in [0, π]
  double roughness = 0.13;
  double view_angle = 0;  ///< θ_o between normal and view, rad, in [0, π/2]
};

/// GTSO's table, side⁴ values in 8 bits (255 is 1) of eq. 30 at a reflectance of 0.04, by
///     x = α_v/(π/2),   y = (F(β) − F(0))/(F(π) − F(0)),   √r,   θ_o/(π/2),
///     F(β) = t/√(1 + t²), t = (β − α_v)/(2 r),
/// each in steps of 1/(side − 1) from 0 on, the first running fastest. F is how GGX's lobe falls off across a
/// straight edge that far from its middle, so that values hardly bend along y, however narrow the lobe is.
///
/// Eq. 30 leaves open on which side of the mirrored view the bent normal lies. Here it is in the plane of
/// normal and view, on the normal's side, about which what is open tends to lie.
struct SpecularTable {
  int side = 0;
  std::vector<std::uint8_t> values;
};

/// Throws UsageError unless 4 ≤ side ≤ 64 is a multiple of 4, Cancelled when the watch says so. The same to
/// the last bit for any number of threads.
SpecularTable make_specular_table(int side, const Watch& watch = {});

/// Between the table's values, linearly. Arguments beyond its ends are taken to be at them.
double look_up(const SpecularTable& table, const ConeArguments& arguments);

/// How far a table is from eq. 30.
struct TableError {
  double rmse = 0;
  double largest = 0;
};

/// At so many random arguments: A, √r and θ_o up to 85° evenly, β evenly as far as the bent normal is above
/// the surface.
TableError judge_specular_table(const SpecularTable& table, int count, std::uint64_t seed,
                                const Watch& watch = {});

}  // namespace heightlight
