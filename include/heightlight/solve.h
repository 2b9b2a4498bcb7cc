#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "heightlight/evidence.h"
#include "heightlight/image.h"
#include "heightlight/surface.h"
#include "heightlight/transport.h"
#include "heightlight/visibility.h"
#include "heightlight/watch.h"

// One call: a request on a surface gives results and the evidence for them.
//
//     using namespace heightlight;
//     const Surface surface = build_surface({.height = heights, .spacing = {0.01, 0.01}});
//     const Results results = solve(surface, {.wanted = {.sky = true, .totals = {{.constant = {0.5}}}}});
//     // results.sky_view_factor, results.totals[0][0], results.evidence.total_checks[0].total_rmse
//
// Only what is asked for is computed. Results are the same to the last bit for any number of threads, and
// whatever else is solved at the same time in other threads of the program.

namespace heightlight {

/// Takes single bounces at ρ = 1 as they are found, so that they need not be kept.
class BounceSink {
 public:
  virtual ~BounceSink() = default;

  /// α and A, before the first bounce; both outlive the last one.
  virtual void take_sky(const Map& ambient_occlusion, const Map& sky_view_factor) = 0;
  /// What carries light from bounce to bounce, before anything bounces: the links of rays and slices, which
  /// are gone afterwards.
  virtual void take_links(const FormFactors&) {}
  /// E_b/π, b = 0, 1 … K in order.
  virtual void take_bounce(int b, const TexelVector& irradiance) = 0;
  /// What all later bounces bring together, E/π.
  virtual void take_tail(const TexelVector& irradiance) = 0;
};

/// What is to be found.
struct Wanted {
  bool sky = false;        ///< α and A
  SkyWanted moments = {};  ///< of the sky: bent normals, cones and harmonics follow from them
  std::vector<SkyDefinition> definitions = {};  ///< what terrain science calls by these names
  std::vector<double> horizon_rad =
      {};  ///< azimuths toward which horizons are found, counterclockwise from x
  std::optional<MaximumDistance> maximum_distance =
      {};                           ///< as far as occluders count for all of the above; never for bounces
  std::vector<Albedo> totals = {};  ///< albedos at which the total of all bounces is found
  bool seen = false;                ///< n of every texel (forms.h), solved for at kSeenAlbedo
  int bounces = 0;  ///< K > 0: E₀ … E_K apart, for `sink`, or in Results where there is none
  /// E₀/π of light of one's own, for `totals`; the sky's where empty. One for all channels, or one for each:
  /// an albedo of one channel has as many totals then.
  std::vector<TexelVector> direct = {};
  /// Of α, A, the moments, definitions made of A, and the sky's light for `totals`. What surfaces see of each
  /// other stays. `seen` and single bounces are those of a sky all around: they refuse `ground`.
  BelowHorizontal below = BelowHorizontal::sky;
};

/// How it is to be found.
struct Accuracy {
  Visibility visibility = Visibility::horizon_walks;
  double error = 0.002;  ///< of horizon walks: RMSE > 0 of A, and of totals at albedos up to 0.8
  int azimuths = 0;      ///< of horizon walks: those of the sky, fixed, 0: chosen; of exact slices: 0 is 128
  int rays = 300;        ///< per receiver
  std::uint64_t seed = 1;
  std::optional<HorizonPlan> plan = {};  ///< of horizon walks, in place of a plan made for the error
};

/// What evidence is to be found; each costs exact walks from a few hundred receivers, or a gather.
struct Checks {
  bool sky = true;      ///< Evidence::sky_check, of maps of the sky
  bool totals = true;   ///< Evidence::total_checks, of totals
  bool energy = true;   ///< Evidence::energy, of single bounces
  bool bounces = true;  ///< Evidence::bounce_rmse
};

struct Limits {
  std::uint64_t memory = ~0ULL;  ///< bytes that all of it may take. Totals that miss the error
                                 ///< are found once more only where it holds what that takes
  int threads = 0;               ///< 0: as OpenMP has it
};

struct Request {
  Wanted wanted = {};
  Accuracy accuracy = {};
  Checks checks = {};
  Limits limits = {};
  Watch watch = {};
  BounceSink* sink = nullptr;
  /// An operator that find_operator found for this surface, this accuracy and this direct irradiance: bounces
  /// and totals go by it, and are the same, to the last bit, as where each request finds its own. Its sky is
  /// the one of `wanted.sky`.
  const PlannedTransport* transport = nullptr;
};

/// What was asked for; the rest is empty. All maps have the surface's size.
struct Results {
  Map ambient_occlusion;  ///< α as far as the maximum distance, [0, 1]; NaN where the sample is missing, here
                          ///< and below
  Map sky_view_factor;  ///< A, likewise
  SkyMoments moments;
  std::vector<Map> definitions;  ///< per definition asked for
  std::vector<Map> horizons;     ///< elevations above what is level at the place, rad, at least those of the
                                 ///< tangent plane, per azimuth asked for
  /// E/π of all bounces: [albedo][channel], in double precision, 0 where the sample is missing (to_map makes
  /// maps).
  std::vector<std::vector<TexelVector>> totals;
  std::vector<TexelVector> bounces;  ///< E_b/π at ρ = 1, b = 0 … K
  TexelVector tail;                  ///< and of all later ones together
  Map whole_sky_view_factor;         ///< A without a maximum distance, which `seen` goes with
  Map seen;                          ///< n
  Evidence evidence;
};

/// Solves. Throws UsageError, naming the quantity, for what makes no sense, MemoryError before anything is
/// taken that `limits.memory` does not hold, Cancelled when the watch says so.
Results solve(const Surface& surface, const Request& request);

/// The operator that a request's bounces and totals go by, for many requests (Request::transport). Of
/// `request`, the accuracy, the limits, the watch and `wanted.direct` count: it is planned for that light,
/// and bears other light of any kind, at more or less than the error wanted. `surface` must outlive it.
/// Throws as solve does.
PlannedTransport find_operator(const Surface& surface, const Request& request);

/// Bytes that solving takes at its worst moment on a map of that size, beside the links: from the sizes of
/// the types that it holds. What the caller holds is not in it.
std::uint64_t estimate_memory(int width, int height, const Request& request);

/// Unit bent normals from first moments; the surface's own normal where nothing of the sky is seen. NaN where
/// the sample is missing.
Image<Vector3> bent_normals(const SkyMoments& moments, const Surface& surface);

}  // namespace heightlight
