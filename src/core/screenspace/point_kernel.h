#pragma once

#include <array>
#include <vector>

#include "heightlight/screenspace.h"
#include "heightlight/sky_light.h"
#include "screenspace/slice_samples.h"

// Containment tests (files 001 and 002) for one row of receivers: points of the tangent hemisphere are looked
// up in the depth buffer; a point below the surface hides its direction.
//
// A point (X, Y, Z) lies at x + X T + Y B + Z N, with the frame of the shader of Umenhoffer et al. 2009, T =
// N × (0, 1, 0.01) made unit and B = N × T, turned about N by the texel's noise. The surface there is
// interpolated on its triangle (a GPU's bilinear fetch would do as much), so that a tilted plane does not
// hide itself.

namespace heightlight {

/// Albedos that vary: a red, a green and a blue one at most.
constexpr std::size_t kMostAlbedos = 3;

/// A point to test, in the tangent frame, world units, and what it counts if it is open.
struct TangentPoint {
  float x = 0, y = 0, z = 0;
  float weight = 1;
  float kept = 0;  ///< what it counts beside that, open or not
};

/// A point counts as below the surface only by more than this share of the radius: a plane does not hide
/// itself for what rounding does.
constexpr double kPointBias = 1e-4;

/// How rows are looked at.
struct PointPass {
  const DepthBuffer& depth;
  const std::vector<TangentPoint>& points;
  /// Places tested on the way to each point, evenly apart; it is open where all of them are.
  int tests = 1;
  float bias = 0;                                ///< world units
  std::array<float, kNoiseRanks> turn_cosine{};  ///< of the frame, by noise rank
  std::array<float, kNoiseRanks> turn_sine{};
  /// Of the surface, one per albedo that varies (kMostAlbedos of them), all of the map's size: read at the
  /// first place that lies below it.
  std::vector<const Map*> albedos{};
  const SkyGrid* sky = nullptr;  ///< where its light is asked for
};

/// Sums over the points, per receiver in a row of the map.
struct PointSums {
  std::vector<float> open;  ///< Σ weight of what is open
  /// Red, green and blue: Σ radiance × (weight of what is open, and what is kept). Empty without a sky.
  std::array<std::vector<float>, 3> sky;
  std::vector<std::vector<float>> albedo;  ///< Σ weight × albedo of what is hidden, per albedo
};

/// Turns of the ranks in a frame, by equal parts of a full turn.
void set_turns(DirectionNoise noise, int frame, PointPass& pass);

/// Adds to the sums of the row's receivers. The readable one.
void test_points_scalar(const PointPass& pass, int row, PointSums& sums);

/// The fast one: receivers four apart side by side. The same, but for the rounding of fused products, which
/// may put a point that lies on the surface on its other side.
void test_points(const PointPass& pass, int row, PointSums& sums);

/// The indirect bounce of Ritschel et al. 2009, of one row: Σ L A cosθ_s cosθ_r / d² over the points that are
/// hidden, with L the `sender` map at the texel nearest to the point, the sender's cosine from that texel's
/// normal, and d at least `least_distance`. `area` is A_s. Adds to `received`.
struct BouncePass {
  PointPass points;
  const Map& sender;
  float area = 0;
  float least_distance = 0;
};
void bounce_points_scalar(const BouncePass& pass, int row, std::vector<float>& received);
void bounce_points(const BouncePass& pass, int row, std::vector<float>& received);

}  // namespace heightlight
