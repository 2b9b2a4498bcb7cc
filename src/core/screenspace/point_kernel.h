#pragma once

#include <array>
#include <vector>

#include "heightlight/screenspace.h"
#include "heightlight/sky_light.h"
#include "screenspace/slice_samples.h"

// Containment tests (Umenhoffer et al. 2009, Ritschel et al. 2009) for one row of receivers: points of the
// tangent hemisphere are looked up in the depth buffer; a point below the surface hides its direction.
//
// A point (X, Y, Z) lies at x + X T + Y B + Z N. The frame is the one in the shader of Umenhoffer et al.
// 2009: T is N × (0, 1, 0.01) normalized, B = N × T, both turned about N by the texel's noise. The surface
// there is interpolated on its triangle (a GPU's bilinear fetch would do as well), so that a tilted plane
// does not hide itself.

namespace heightlight {

/// The most albedo maps: red, green and blue.
constexpr std::size_t kMostAlbedos = 3;

/// A point to test, in the tangent frame, world units, and its weight if it is open.
struct TangentPoint {
  float x = 0, y = 0, z = 0;
  float weight = 1;
  float kept = 0;  ///< further weight that counts whether it is open or not
};

/// A point counts as below the surface only if it is below by more than this share of the radius, so that a
/// plane does not hide itself by rounding.
constexpr double kPointBias = 1e-4;

/// How the points of a row's receivers are tested.
struct PointPass {
  const DepthBuffer& depth;
  const std::vector<TangentPoint>& points;
  /// Number of places tested on the line to each point, evenly spaced; the point is open if all of them are.
  int tests = 1;
  float bias = 0;                                ///< world units
  std::array<float, kNoiseRanks> turn_cosine{};  ///< of the frame, by noise rank
  std::array<float, kNoiseRanks> turn_sine{};
  /// Albedo maps of the surface, at most kMostAlbedos, all of the map's size. They are read at the first
  /// place that lies below the surface.
  std::vector<const Map*> albedos{};
  const SkyGrid* sky = nullptr;  ///< where radiance from the sky is asked for; else null
};

/// Sums over the points, per receiver in a row of the map.
struct PointSums {
  std::vector<float> open;  ///< Σ weight of the open points
  /// Red, green and blue: Σ radiance × (weight if open, plus `kept`). Empty without a sky.
  std::array<std::vector<float>, 3> sky;
  std::vector<std::vector<float>> albedo;  ///< Σ weight × albedo of the hidden points, per albedo
};

/// Sets the turns of the ranks in a frame, in equal parts of a full turn.
void set_turns(DirectionNoise noise, int frame, PointPass& pass);

/// Adds to the sums of the row's receivers. The readable version.
void test_points_scalar(const PointPass& pass, int row, PointSums& sums);

/// As test_points_scalar, vectorized over receivers four columns apart. The results differ only by the
/// rounding of fused products, which may move a point that lies on the surface to its other side.
void test_points(const PointPass& pass, int row, PointSums& sums);

/// The indirect bounce of Ritschel et al. 2009 for one row: Σ L `area` cosθ_s cosθ_r / d² over the hidden
/// points. L is the `sender` map at the texel nearest to the point, θ_s is measured from that texel's normal,
/// and d is at least `least_distance`. With A_s/π as `area` the sum is E/π. Both functions add to `received`.
struct BouncePass {
  PointPass points;
  const Map& sender;
  float area = 0;
  float least_distance = 0;
};
void bounce_points_scalar(const BouncePass& pass, int row, std::vector<float>& received);
void bounce_points(const BouncePass& pass, int row, std::vector<float>& received);

}  // namespace heightlight
