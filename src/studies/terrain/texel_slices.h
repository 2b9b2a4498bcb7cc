#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "heightlight/surface.h"
#include "visibility/slice_integrals.h"

namespace heightlight {

/// A horizontal unit vector.
struct AzimuthDirection {
  double x = 1;
  double y = 0;

  explicit AzimuthDirection(double azimuth_rad) : x(std::cos(azimuth_rad)), y(std::sin(azimuth_rad)) {}
};

/// A texel's normal in the vertical plane of an azimuth.
inline SliceNormal slice_normal(const Surface& surface, std::size_t texel, const AzimuthDirection& azimuth) {
  const Vector3& normal = surface.normal.values[texel];
  return {double{normal.x} * azimuth.x + double{normal.y} * azimuth.y, double{normal.z}};
}

/// −π/2, which says that there is no surface, has the slope −∞.
inline double slope_of_horizon(double elevation_rad) {
  return elevation_rad <= -std::numbers::pi / 2 ? -std::numeric_limits<double>::infinity()
                                                : std::tan(elevation_rad);
}

}  // namespace heightlight
