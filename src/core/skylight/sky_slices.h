#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "heightlight/sky_light.h"
#include "visibility/slice_integrals.h"

namespace heightlight {

/// A sky as horizons cut it: per azimuth, what it sends from an elevation upwards.
///
/// A slice of azimuths Δφ with the horizon h gives a receiver with normal n, whose component along the
/// azimuth is n_d, the irradiance
///     ∫ L(θ) (n_d cosθ + n_z sinθ) cosθ dθ Δφ,  θ from h to π/2,
/// which is n_d P(h) + n_z Q(h) with P = ∫ L cos²θ dθ and Q = ∫ L sinθ cosθ dθ. L is the radiance's mean over
/// the slice's azimuths, so that no light is lost between them however small it is. Rows of the sky have one
/// L each, which makes P and Q sums of closed forms.
class SkySlices {
 public:
  /// For the azimuths φ_k = 2π (k + ¼)/K of exact walks (exact_walk.h), each the middle of its slice.
  SkySlices(const SkyLight& sky, int azimuths);

  /// Bytes that so many slices of a sky take.
  static std::uint64_t bytes(const SkyLight& sky, int azimuths);

  /// The same of one of the azimuths, but for the division: what its slice sends above a horizon. `in_slice`
  /// is the receiver's normal there.
  Eigen::Vector3d from_slice(std::size_t azimuth, const SliceNormal& in_slice, double horizon_rad) const {
    const Sums sums = above(azimuth, horizon_rad);
    return in_slice.along * sums.cosine_squared + in_slice.up * sums.sine_cosine;
  }

  /// E/π, red, green and blue, of a receiver with the unit `normal` above the horizons, per azimuth, in
  /// radians; the tangent plane hides what lies below it. As A does (exact_walk.h), it is divided by the
  /// slices' sum for an open receiver, so that an even sky of radiance 1 sends A.
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
