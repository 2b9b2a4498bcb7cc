#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "heightlight/image.h"
#include "heightlight/surface.h"

namespace heightlight {

/// How many rays a receiver sends, and how they are turned.
struct RayOptions {
  int rays = 1024;  ///< per receiver, 1 … 65536, stratified in solid angle over the tangent hemisphere
  std::uint64_t seed = 1;  ///< of the per-texel rotations
};

/// Throws UsageError unless the number of rays is in its range.
void check_ray_options(const RayOptions& options);

/// How a horizon walk looks around; each is a bargain between time and error.
struct WalkOptions {
  int azimuths = 32;  ///< K, even, 2 … 65536; φ_k = 2π (k + ¼) / K in the world, from x to y
  int samples_per_octave =
      16;  ///< ν, 8, 16, 32 …: samples per octave of distance; all breakpoints up to ν/2 texels
  float peak_share =
      0.3F;  ///< of a block's highest sample in the height that stands for it; the rest is its mean
};

/// Throws UsageError unless the number is even and in its range.
void check_azimuths(int azimuths);

/// How horizon walks find the sky's shares. Quadrature errs most where much of the surface is seen, so that
/// every other azimuth will do elsewhere.
struct SkyPlan {
  WalkOptions walk = {};
  double full_from = 0;  ///< > 0: RMS of 1 − A, by every other azimuth, in a block of 4 × 16 receivers from
                         ///< which all azimuths are walked; their number is a multiple of 4
  double full_share = 1;  ///< of the blocks, those that walk all azimuths, by the calibration sample
  double error =
      0;  ///< RMSE of A expected, from the calibration sample; 0 of a plan that was not made for an error
  double sampled = 0;  ///< the part of it that azimuths share, from sampling
};

/// What lies below the horizontal of a place in directions that miss the surface, as those do that leave an
/// open map.
enum class BelowHorizontal {
  sky,    ///< as bright as above: A of a plane is 1 however it is tilted
  ground  ///< nothing that shines, as terrain tools have it: A of a plane tilted by S is (1 + cos S)/2
};

/// The one of that name: sky or ground. Throws UsageError where there is none.
BelowHorizontal below_horizontal_named(const std::string& name);

/// From where azimuths count.
enum class AzimuthConvention {
  math,  ///< counterclockwise from x
  north  ///< clockwise from north, which is y, up the map
};

/// The one of that name: math or north. Throws UsageError where there is none.
AzimuthConvention azimuth_convention_named(const std::string& name);

/// So many azimuths from 0 on, in equal steps, as angles counterclockwise from x, rad.
std::vector<double> equal_azimuths(int count, AzimuthConvention convention);

/// What terrain science calls a sky view factor, or openness, by name. Means are over azimuths, equally
/// spaced; h is the elevation of the horizon above the place's own horizontal, as it is: the tangent plane
/// does not limit it, and on a ridge it is below 0. Where the formula says h ≥ 0 it is taken as 0 there.
enum class SkyDefinition {
  svf_tilted,         ///< A
  svf_horizontal,     ///< mean cos² h, h ≥ 0: what a level receiver gets
  svf_solid_angle,    ///< 1 − mean sin h, h ≥ 0 (Zakšek, Oštir and Kokalj 2011)
  openness_positive,  ///< mean of π/2 − h, rad (Yokoyama, Shirasawa and Pike 2002). An azimuth toward which
                      ///< there is no surface at all takes the tangent plane
  openness_negative,    ///< the same of the surface turned upside down
  mean_cos_h,           ///< mean cos h, h ≥ 0
  terrain_view_factor,  ///< 1 − A
};

/// Of a definition: its name, as svf-tilted; its formula in a line of ASCII; and the unit, 1 or rad.
struct SkyDefinitionFacts {
  SkyDefinition definition;
  const char* name;
  const char* formula;
  const char* unit;
};

/// In the order of SkyDefinition.
const std::vector<SkyDefinitionFacts>& sky_definitions();

const SkyDefinitionFacts& facts_of(SkyDefinition definition);

/// The one of that name. Throws UsageError where there is none.
SkyDefinition sky_definition_named(const std::string& name);

/// What horizon walks are to find of the sky beside its shares α and A.
struct SkyWanted {
  bool first = false;   ///< SkyMoments::first, of which bent normals and cones are made
  bool second = false;  ///< SkyMoments::second, which with the others makes spherical harmonics of order 2
};

/// Moments (1/π) ∫ V f(ω) cosθ dω of what a receiver sees of the sky, in world axes: V is 1 toward the sky
/// and 0 toward the surface, θ counts from the normal. A is that of f = 1. Empty unless wanted; NaN where the
/// sample is missing.
struct SkyMoments {
  Image<Vector3> first;                ///< of ω
  Image<std::array<float, 5>> second;  ///< of x² − y², xy, z², xz, yz
};

/// Unit vector along a first moment; the receiver's normal where nothing of the sky is seen.
Vector3 bent_normal(const Vector3& first_moment, const Vector3& normal);

/// How what is near a receiver counts for more than what is far: a direction in which the surface stands at
/// distance d counts as open by the share μ(d) (Umenhoffer et al. 2009, section 2), which is 1 from the
/// maximum distance D on.
enum class Falloff {
  none,        ///< 0: all that stands nearer than D occludes wholly
  linear,      ///< d/D
  root,        ///< √(d/D)
  exponential  ///< 1 − exp(−4 d/D), scaled to be 1 at D (exponential_openness, forms.h)
};

/// Their names in that order: none, linear, sqrt, exponential.
const std::vector<std::string>& falloff_names();

/// The one of that name. Throws UsageError where there is none.
Falloff falloff_named(const std::string& name);

/// As far as occluders count.
struct MaximumDistance {
  double distance = 0;  ///< D > 0, world units, in space (not on the map)
  Falloff falloff = Falloff::none;
};

/// A place on the surface: a point of the cell whose upper left vertex is `cell` (index into the height
/// image). `across` and `down` are its coordinates inside the cell, in [0, 1]; across ≥ down is the upper
/// right triangle.
struct SurfacePoint {
  std::uint32_t cell = 0;
  float across = 0;
  float down = 0;
};

/// What one receiver's rays found.
struct ReceiverView {
  int rays = 0;  ///< rays sent; 0 where the sample is missing
  const double* weight =
      nullptr;  ///< per ray, form factor of its direction: cosθ / Σ cosθ; `rays` of them, sum 1
  std::uint8_t weight_table = 0;    ///< which of the caster's weight tables that is
  std::vector<std::uint16_t> ray;   ///< of each hit: the ray's number, ascending
  std::vector<SurfacePoint> place;  ///< of each hit: where it ended
};

/// The sky's share of a receiver's hemisphere.
struct SkyShare {
  double ambient_occlusion = 1;  ///< α: of the solid angle
  double sky_view_factor = 1;    ///< A: of the form factor, so that A + Σ hits' weights = 1
};

/// Of a view with at least one ray.
SkyShare sky_share(const ReceiverView& view);

/// Root mean square error of A from `options.rays` rays, measured on up to 256 receivers against sixteen
/// times as many rays (65536 at most) that are turned otherwise. NaN where no sample is present; 0 where the
/// surface has no facet.
double estimate_ray_rmse(const Surface& surface, const RayOptions& options);

}  // namespace heightlight
