#pragma once

#include <Eigen/Core>

namespace heightlight {

/// An elevation above the horizontal, in [−π/2, π/2], as the integrals need it. The default is the zenith.
struct Elevation {
  double cosine = 0;
  double sine = 1;
};

/// Of a slope, height per way; ±∞ are the zenith and the nadir.
Elevation elevation_of_slope(double slope);

/// A receiver's unit normal in the vertical plane of one azimuth d: its share along d, and that along z.
struct SliceNormal {
  double along = 0;  ///< n_xy · d, in [−1, 1]
  double up = 1;     ///< n_z, in [0, 1]
};

/// Slope of the tangent plane along the azimuth: the hemisphere's lower end. ±∞ where the normal is level.
double tangent_slope(const SliceNormal& normal);

/// ∫ (n·ω) cosθ dθ between two elevations, from ≤ to, neither below the tangent plane: an interval's form
/// factor but for dφ/π, which normalisation supplies. Additive to rounding.
double cosine_mass(const SliceNormal& normal, const Elevation& from, const Elevation& to);

/// A, from horizons one azimuth after the other.
class SkyShareSum {
 public:
  /// A horizon by its slope, −∞ where there is no surface: the tangent plane may lie above it.
  void add(const SliceNormal& normal, double horizon_slope);
  double value() const { return open_ / whole_; }

 private:
  double open_ = 0;
  double whole_ = 0;
};

/// Where on a straight stretch of the profile, as a share of it in [0, 1] from its near end to its far one,
/// its light comes from: the mean weighted as in `cosine_mass`. The near end is seen at `from` after
/// `from_way`, the far one at `to` after `to_way`, 0 < from_way ≤ to_way. What is linear along the stretch is
/// thus gathered exactly but for a quadrature of three nodes.
double mean_share(const SliceNormal& normal, const Elevation& from, const Elevation& to, double from_way,
                  double to_way);

/// ∫ cosθ dθ from an elevation to the zenith: solid angle per azimuth, in [0, 2].
double solid_angle_above(const Elevation& from);

/// ∫ ω (n·ω) cosθ dθ from an elevation to the zenith, ω in components along d and z.
Eigen::Vector2d bent_mass_above(const SliceNormal& normal, const Elevation& from);

/// The same of ω_d², the square along d, and of ω_d ω_z. (That of ω_z² is the mass less that of ω_d².)
Eigen::Vector2d second_mass_above(const SliceNormal& normal, const Elevation& from);

}  // namespace heightlight
