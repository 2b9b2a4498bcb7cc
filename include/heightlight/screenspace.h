#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "heightlight/sky_light.h"
#include "heightlight/surface.h"

// Screen-space methods: what games run, on exactly the surface that the reference uses, seen from straight
// above and orthographically. The depth buffer is the height map, a pixel is a texel, the view vector is +z,
// so that a method's difference from the reference is its own error. Jimenez et al. 2016 defines GTAO,
// Umenhoffer et al. 2009 the ambient transfer, Ritschel et al. 2009 SSDO.
//
// All lengths are in world units. Results are the same for any number of threads.

namespace heightlight {

/// What a renderer hands to a screen-space method: depth and normals. Heights are kept in columns of four
/// phases, so that texels four apart, which share their noise, lie side by side: column c of a row is value
/// c / 4 of phase c mod 4. Under `tile` heights have the map's period; an open map lies on a torus of twice
/// its size whose other part is empty (kNoDepth), so that no sample needs to know of borders.
struct DepthBuffer {
  static constexpr int kPhases = 4;

  int width = 0;
  int height = 0;
  int period_columns = 0;  ///< of the torus
  int period_rows = 0;
  int stride = 0;  ///< values of one phase of a row; the last ones continue around the torus
  Spacing spacing;
  Boundary boundary = Boundary::tile;
  double relief = 0;
  std::vector<float> heights;  ///< period_rows × kPhases × stride; kNoDepth where nothing is
  // Of the receivers' tangent planes, height × kPhases × stride: rise per world unit, and the normal's z.
  std::vector<float> slope_x, slope_y, normal_z;
  // The same in rows, as filters read them. NaN where the sample is missing.
  Map row_height, row_slope_x, row_slope_y, row_normal_z;

  std::size_t index(int row, int column) const {
    return (static_cast<std::size_t>(row) * kPhases + static_cast<std::size_t>(column % kPhases)) *
               static_cast<std::size_t>(stride) +
           static_cast<std::size_t>(column / kPhases);
  }
};

/// Below everything, and finite, so that a weight of zero takes it away.
constexpr float kNoDepth = -1e30F;

/// Bytes that make_depth_buffer takes for a map of that size.
std::uint64_t depth_buffer_bytes(int width, int height, Boundary boundary);

DepthBuffer make_depth_buffer(const Surface& surface);

/// Beyond this distance nothing can raise a horizon by what matters: where the whole relief spans a slope of
/// 0.004, four times the map's size at most; for open maps their diagonal.
double largest_radius(const DepthBuffer& depth);

/// What a screen-space method says of every texel; NaN where the sample is missing.
struct ScreenSpaceView {
  Map sky_view_factor;         ///< its word for A, [0, 1]: what a renderer would multiply irradiance by
  Map ambient_occlusion;       ///< its word for α; 0 × 0 where it has none
  Image<Vector3> bent_normal;  ///< unit, cosine weighted, world axes; 0 × 0 where there is none
  Map seen;  ///< n, the mean sky view factor of what a texel sees, [0, 1]; 0 × 0 where there is none
  std::vector<Map> totals;       ///< E/π with what the method knows of bounces, per albedo; may be empty
  double samples_per_texel = 0;  ///< depths that were looked up
};

/// Where along a direction the samples lie, s in (0, 1] of the radius, k = 0 … N − 1.
enum class StepDistribution {
  uniform,    ///< (k + 1)/N
  quadratic,  ///< ((k + 1)/N)²
  stratified  ///< ((k + u)/N)², u by the 4 × 4 noise: all of the interval is looked at by some texel
};

/// What a sample between texels reads.
enum class DepthSampling {
  nearest,  ///< the nearest texel, taken to lie where that texel is, as GPUs do with point sampling
  mesh      ///< the triangulated surface (three texels), which converges to the reference
};

/// How directions differ between texels.
enum class DirectionNoise {
  none,     ///< all texels look along the same ones
  spatial,  ///< sixteen turns in squares of 4 × 4 texels, and a bilateral gather of 4 × 4 results
  temporal  ///< six frames, each turned by a sixth of what the spatial noise leaves open, put together
};

/// GTAO, Jimenez et al. 2016, algorithms 1 and 2. One slice serves both of its sides.
struct GtaoOptions {
  int slices = 3;
  int steps = 3;  ///< per side of a slice
  StepDistribution distribution = StepDistribution::quadratic;
  DepthSampling sampling = DepthSampling::nearest;
  DirectionNoise noise = DirectionNoise::spatial;
  double radius = std::numeric_limits<double>::infinity();  ///< > 0, horizontally; largest_radius at most
  double falloff = 0;           ///< in [0, 1]: the outer share of the radius where horizons sink towards −1
  double thickness = 0;         ///< β of eq. 13, ≥ 0; 0 leaves the heuristic out
  bool divide_by_open = false;  ///< divide by what the same slices give an open hemisphere; not in the paper
  bool bent_normal = false;     ///< algorithm 2
  /// Of the temporal noise: the share that each new frame has in an exponential accumulation buffer that has
  /// run for ever, in (0, 1]; 0: the plain mean of the six turns.
  double accumulation = 0;
};

/// Beside its A, which is the paper's, α from the same horizons: what the forms of α are fed. Throws
/// UsageError for options outside their range.
ScreenSpaceView gtao(const DepthBuffer& depth, const GtaoOptions& options);

/// GTAO of a quarter of the texels, spread back to all by a bilateral filter (Jimenez et al. 2016,
/// section 4.3). Bent normals are left out. Throws as gtao does.
ScreenSpaceView gtao_half_resolution(const DepthBuffer& depth, const GtaoOptions& options);

/// GTAO, and along the same horizons one bounce gathered: a sample that raises the horizon from m to m' is
/// seen through the form factor between them, and sends what a first pass found as its A. Fills `seen`, with
/// which bounced_total (forms.h) gives all bounces at any albedo. Bent normals, falloff and thickness are
/// left out. Throws as gtao does.
ScreenSpaceView gtao_with_bounce(const DepthBuffer& depth, const GtaoOptions& options);

/// HBAO (Bavoil, Sainz and Dimitrov 2008, as Jimenez et al. 2016 describes it): horizons above the tangent
/// plane's angle t,
///     1 − mean over azimuths of (sin h − sin t),
/// where every sample that raises the horizon weighs by 1 − (r/R)², r its distance and R the radius. It
/// leaves out the cosine to the normal: without that weight it converges to α, not to A.
struct HbaoOptions {
  int slices = 2;  ///< two azimuths each
  int steps = 4;   ///< per azimuth
  StepDistribution distribution = StepDistribution::uniform;
  DepthSampling sampling = DepthSampling::nearest;
  DirectionNoise noise = DirectionNoise::spatial;
  double radius = std::numeric_limits<double>::infinity();  ///< > 0; largest_radius at most
  bool attenuated = true;                                   ///< false: every sample weighs 1
};

/// The same map as α and as A, since renderers take it for either. Throws UsageError for options outside
/// their range.
ScreenSpaceView hbao(const DepthBuffer& depth, const HbaoOptions& options);

/// Albedo of the surface: one number in [0, 1], or, where `map` is given, one per texel.
struct SurfaceAlbedo {
  double constant = 0.5;
  const Map* map = nullptr;
};

/// μ of Umenhoffer et al. 2009: how far a surface at distance d counts as open, up to R.
enum class FuzzyMeasure {
  step,        ///< 0: all that is nearer than R hides wholly
  root,        ///< √(d/R)
  exponential  ///< exponential_openness (forms.h)
};

/// Obscurance and ambient transfer by containment tests (Umenhoffer et al. 2009, eqs. 5, 7 and 9). Directions
/// and distances are n points of a Lloyd-relaxed Poisson disc distribution, the same for all texels but for
/// sixteen turns about the normal.
struct AmbientTransferOptions {
  int samples = 16;  ///< n
  int tests = 1;     ///< m, containment tests on the way to each sample
  FuzzyMeasure measure = FuzzyMeasure::root;
  DirectionNoise noise = DirectionNoise::spatial;
  double radius = 1;  ///< R > 0, finite
};

/// The obscurance O as the method's word for A, and per albedo the transfer W, with the albedo read where a
/// sample is found to be hidden. Throws UsageError for options outside their range.
ScreenSpaceView ambient_transfer(const DepthBuffer& depth, const std::vector<SurfaceAlbedo>& albedos,
                                 const AmbientTransferOptions& options);

/// SSDO (Ritschel et al. 2009, section 3): N directions, uniform over the hemisphere, each tested at one
/// random distance; the sky's radiance is taken from the directions found open. Then one bounce from the
/// hidden samples, with sender areas of π R²/N.
struct SsdoOptions {
  int samples = 16;  ///< N
  DirectionNoise noise = DirectionNoise::spatial;
  double radius = 1;  ///< r_max > 0, finite
  /// Section 6: "a smooth-step function to fade out shadows from blockers close to the border of the
  /// hemisphere", here over the outer half of the radius.
  bool smooth_end = false;
};

/// Direct irradiance under an even sky, and per albedo the direct one with one bounce. Distances between
/// sender and receiver are taken to be at least a texel: the paper clamps to "1", whose unit it does not say.
/// Throws UsageError for options outside their range.
ScreenSpaceView ssdo(const DepthBuffer& depth, const std::vector<SurfaceAlbedo>& albedos,
                     const SsdoOptions& options);

/// Of the sphere, what each of its directions stands for, sr: what the sky should be averaged over.
double ssdo_solid_angle(const SsdoOptions& options);

/// Direct irradiance E/π under any sky, red, green and blue, the radiance looked up along each open direction
/// (Ritschel et al. 2009, eq. 1); NaN where the sample is missing. Throws as ssdo does.
Image<Vector3> ssdo_under_sky(const DepthBuffer& depth, const SkyGrid& sky, const SsdoOptions& options);

/// The role (below) of GTAO at a usual preset.
inline constexpr const char* kRoleOfGames = "GTAO as games run it";

/// One line of the table of methods: a method with its parameters, ready to run.
struct ScreenSpaceMethod {
  std::string name;        ///< of the method: "gtao"
  std::string parameters;  ///< in words, without commas
  /// Representative: its error is drawn, and those of closed forms on it.
  bool shown = false;
  std::string role = {};      ///< of the few that stand at the head of reports: kRoleOfGames, say
  bool finds_totals = false;  ///< for each albedo that it is given
  int directions = 0;         ///< per texel, of those in Jimenez et al. 2016, figure 5; 0 of others
  std::function<void()> prepare =
      {};  ///< makes what a renderer has in its code; empty where nothing is to be made
  std::function<ScreenSpaceView(const DepthBuffer&, const std::vector<SurfaceAlbedo>&)> run = {};
  double sky_solid_angle = 0;  ///< sr, that it wants a sky averaged over; 0: it takes A to tell all
  std::function<Image<Vector3>(const DepthBuffer&, const SkyGrid&)> run_under_sky = {};  ///< then empty
};

/// All that are compared. Radii are in units of the map's relief.
const std::vector<ScreenSpaceMethod>& screen_space_methods();

}  // namespace heightlight
