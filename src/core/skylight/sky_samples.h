#pragma once

#include <vector>

#include "heightlight/sky_light.h"

namespace heightlight {

/// A direction that represents a part of the sky.
struct SkySample {
  Vector3 direction;      ///< unit
  float solid_angle = 0;  ///< sr
  Vector3 radiance;
};

/// Divides a sky into directions in at least `rows` rows of latitude, a whole number to each texel. A finer
/// sky is first averaged to `rows` rows, by solid angle, so that its irradiance is preserved.
std::vector<SkySample> sample_sky(const SkyLight& sky, int rows);

/// Unit vector through the middle of a texel.
Vector3 direction_of(const Image<Vector3>& image, int row, int column);

}  // namespace heightlight
