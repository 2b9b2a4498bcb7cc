#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "heightlight/sky_light.h"
#include "visibility/slice_integrals.h"

namespace heightlight {

/// A sky prepared for horizons: per azimuth, the irradiance from an elevation upwards.
///
/// A slice of azimuths Δφ with the horizon h gives a receiver with normal n, whose component along the
/// azimuth is n_d, the irradiance
///     ∫ L(θ) (n_d cosθ + n_z sinθ) cosθ dθ Δφ,  θ from h to π/2,
/// which is n_d P(h) + n_z Q(h) with P = ∫ L cos²θ dθ and Q = ∫ L sinθ cosθ dθ. L is the mean radiance over
/// the slice's azimuths, so that no source is missed between azimuths, however small it is. Each row of the
/// sky has one L, which makes P and Q sums of closed forms.
class SkySlices {
 public:
  /// Prepares the azimuths φ_k = 2π (k + ¼)/K of exact walks (exact_walk.h), each in the middle of its slice.
  SkySlices(const SkyLight& sky, int azimuths);

  /// Bytes that `azimuths` slices of a sky take.
  static std::uint64_t bytes(const SkyLight& sky, int azimuths);

  /// What the slice of one azimuth sends from above a horizon, not divided as in irradiance(). `in_slice` is
  /// the receiver's normal in that slice.
  Eigen::Vector3d from_slice(std::size_t azimuth, const SliceNormal& in_slice, double horizon_rad) const {
    const Sums sums = above(azimuth, horizon_rad);
    return in_slice.along * sums.cosine_squared + in_slice.up * sums.sine_cosine;
  }

  /// E/π, red, green and blue, of a receiver with the unit `normal` from above the horizons, one per azimuth,
  /// in radians. The tangent plane hides what lies below it. As for A (exact_walk.h), the sum is divided by
  /// the sum of the slices for an open receiver, so that an even sky of radiance 1 gives A.
  Eigen::Vector3d irradiance(const Eigen::Vector3d& normal, const std::vector<double>& horizon_rad) const;

 private:
  struct Sums {
    Eigen::Vector3d cosine_squared = Eigen::Vector3d::Zero();  ///< P
    Eigen::Vector3d sine_cosine = Eigen::Vector3d::Zero();     ///< Q
  };

  Sums above(std::size_t azimuth, double elevation_rad) const;

  int azimuths_;
  int rows_;
  std::vector<Eigen::Vector3d> radiance_;  ///< azimuths × rows
  std::vector<Sums> sums_;                 ///< azimuths × (rows + 1), from each row's upper border upwards
};

}  // namespace heightlight
