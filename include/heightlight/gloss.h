#pragma once

#include <cstdint>
#include <vector>

#include "heightlight/image.h"
#include "heightlight/surface.h"
#include "heightlight/watch.h"

// What a glossy surface sees of an even sky. Specular occlusion is (Jimenez 2016, eqs. 24 to 28)
//     S = ∫ V f_r cosθ dω ÷ ∫ f_r cosθ dω
// over the hemisphere of a receiver's normal; S is 1 where all is open. f_r is that of GGX: the normal
// distribution of Walter et al. 2007 (eq. 33), Smith's shadowing of both directions (eqs. 23 and 34), and
// Schlick's form of Fresnel's factor.

namespace heightlight {

/// The gloss of a surface.
struct Gloss {
  double roughness = 0.13;    ///< α of GGX, in (0, 1]: the square of what many engines call roughness
  double reflectance = 0.04;  ///< reflectance at normal incidence, in [0, 1]; the paper's table is for 0.04
};

/// Throws UsageError if a value is outside its range.
void check_gloss(const Gloss& gloss);

/// Throws UsageError unless `view` is finite and points above the horizontal, z > 0. It need not be a unit
/// vector.
void check_view(const Vector3& view);

/// How specular occlusion is found.
struct SpecularOptions {
  Gloss gloss = {};
  Vector3 view = {0, 0, 1};  ///< direction toward a viewer who is far away; world axes, z > 0
  /// Rays per receiver, distributed as the lobe is, from 16 to 65536; 0: as many as `error` requires.
  int rays = 256;
  double error = 0.002;  ///< RMSE of S wanted, > 0; used only where `rays` is 0
  std::uint64_t seed = 1;
  Watch watch = {};
};

/// The specular occlusion of a map.
struct SpecularOcclusion {
  Map occlusion;  ///< S per texel, in [0, 1]; NaN where the sample is missing, or faces away from the view
  /// Expected RMSE of S over the texels, estimated from the differences between sixteen parts of each texel's
  /// rays.
  double rmse = 0;
  int rays = 0;  ///< rays per receiver that were used in the end
};

/// Finds the specular occlusion of every texel by rays into the lobe. Each ray stands for the light that its
/// direction reflects into the view (visible normals, Heitz 2018). In the open, S is exactly 1. Texels that
/// something hides from the viewer are treated like others. Where `rays` is 0, the rays begin at 64 and are
/// multiplied until the error wanted is kept, or 65536 is reached. The result is the same to the last bit for
/// any number of threads. Throws UsageError for options outside their range, and Cancelled when the watch
/// stops the work.
SpecularOcclusion specular_occlusion(const Surface& surface, const SpecularOptions& options);

/// A place in the table of GTSO (Jimenez 2016, eq. 30): a cone that stands for the open directions, and a
/// lobe.
struct ConeArguments {
  /// α_v, half-angle of the cone, rad, in [0, π/2]; its cosine is cone_cosine(A) (occlusion_forms.h).
  double half_angle = 0;
  double apart = 0;  ///< β, between the cone's axis (the bent normal) and the mirrored view, rad, in [0, π]
  double roughness = 0.13;
  double view_angle = 0;  ///< θ_o, between normal and view, rad, in [0, π/2]
};

/// The table of GTSO: side⁴ values of eq. 30 at a reflectance of 0.04, in 8 bits where 255 is 1. Its axes are
///     x = α_v/(π/2),   y = (F(β) − F(0))/(F(π) − F(0)),   √r,   θ_o/(π/2),
///     F(β) = t/√(1 + t²), t = (β − α_v)/(2 r),
/// each in steps of 1/(side − 1) from 0 on; x runs fastest. r is the roughness. F describes how GGX's lobe
/// falls off across a straight edge at that distance from the lobe's middle, so that values hardly bend along
/// y, however narrow the lobe is.
///
/// Eq. 30 does not say on which side of the mirrored view the bent normal lies. Here it lies in the plane of
/// normal and view, on the normal's side, since open directions tend to lie about the normal.
struct SpecularTable {
  int side = 0;
  std::vector<std::uint8_t> values;
};

/// Computes the table. Throws UsageError unless `side` is a multiple of 4 from 4 to 64, and Cancelled when
/// the watch stops the work. The result is the same to the last bit for any number of threads.
SpecularTable make_specular_table(int side, const Watch& watch = {});

/// Returns the table's value at the arguments, in [0, 1], interpolated linearly along all four axes.
/// Arguments outside their range count as the nearer end of it.
double look_up(const SpecularTable& table, const ConeArguments& arguments);

/// The difference between a table's values and eq. 30.
struct TableError {
  double rmse = 0;
  double largest = 0;
};

/// Compares look_up with eq. 30 at `count` random arguments. A and √r are drawn evenly from [0, 1], θ_o
/// evenly up to 85°, and β evenly from 0 to where the bent normal meets the surface. Throws Cancelled when
/// the watch stops the work.
TableError judge_specular_table(const SpecularTable& table, int count, std::uint64_t seed,
                                const Watch& watch = {});

}  // namespace heightlight
