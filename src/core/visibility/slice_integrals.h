#pragma once

#include <Eigen/Core>

namespace heightlight {

/// An elevation above the horizontal, in [−π/2, π/2], as the integrals need it. The default is the zenith.
struct Elevation {
  double cosine = 0;
  double sine = 1;
};

/// Elevation of a slope (height per way); ±∞ give the zenith and the nadir.
Elevation elevation_of_slope(double slope);

/// A receiver's unit normal in the vertical plane of one azimuth d: its components along d and along z.
struct SliceNormal {
  double along = 0;  ///< n_xy · d, in [−1, 1]
  double up = 1;     ///< n_z, in [0, 1]
};

/// Slope of the tangent plane along the azimuth: the hemisphere's lower end. ±∞ where the normal is
/// horizontal.
double tangent_slope(const SliceNormal& normal);

/// ∫ (n·ω) cosθ dθ between two elevations, from ≤ to, neither below the tangent plane. It is the interval's
/// form factor except for dφ/π, which normalisation supplies. Additive up to rounding.
double cosine_mass(const SliceNormal& normal, const Elevation& from, const Elevation& to);

/// Sums up the sky view factor A from horizons, one azimuth after the other.
class SkyShareSum {
 public:
  /// Adds a horizon by its slope, −∞ where there is no surface. Where the tangent plane lies above it, the
  /// tangent plane counts.
  void add(const SliceNormal& normal, double horizon_slope);
  double value() const { return open_ / whole_; }

 private:
  double open_ = 0;
  double whole_ = 0;
};

/// Where on a straight stretch of the profile its radiosity comes from, as a share in [0, 1] of the stretch
/// from its near end to its far end: the mean position, weighted as in `cosine_mass`. The near end is seen at
/// `from` after `from_way`, the far end at `to` after `to_way`, 0 < from_way ≤ to_way. What is linear along
/// the stretch is thus gathered exactly, up to the error of a quadrature with three nodes.
double mean_share(const SliceNormal& normal, const Elevation& from, const Elevation& to, double from_way,
                  double to_way);

/// ∫ cosθ dθ from an elevation to the zenith: solid angle per azimuth, in [0, 2].
double solid_angle_above(const Elevation& from);

/// ∫ ω (n·ω) cosθ dθ from an elevation to the zenith. The components of ω are those along d and z.
Eigen::Vector2d bent_mass_above(const SliceNormal& normal, const Elevation& from);

/// ∫ ω_d² (n·ω) cosθ dθ and ∫ ω_d ω_z (n·ω) cosθ dθ from an elevation to the zenith. (The same integral of
/// ω_z² is the mass less that of ω_d².)
Eigen::Vector2d second_mass_above(const SliceNormal& normal, const Elevation& from);

}  // namespace heightlight
