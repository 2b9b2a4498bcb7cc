#pragma once

#include <vector>

#include "heightlight/sky_light.h"

namespace heightlight {

/// A direction that stands for a part of the sky.
struct SkySample {
  Vector3 direction;      ///< unit
  float solid_angle = 0;  ///< sr
  Vector3 radiance;
};

/// Directions in `rows` rows of latitude or more, a whole number to each texel of the sky; a finer sky is
/// averaged to that many first, by solid angle, so that none of its light is lost.
std::vector<SkySample> sample_sky(const SkyLight& sky, int rows);

/// Unit vector through the middle of a texel.
Vector3 direction_of(const Image<Vector3>& image, int row, int column);

}  // namespace heightlight
