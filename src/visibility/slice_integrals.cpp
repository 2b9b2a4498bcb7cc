#include "visibility/slice_integrals.h"

#include <cmath>

// A hemisphere in slices: at azimuth d (a unit vector in the horizontal plane) and elevation θ the direction
// is
//     ω(θ) = cosθ d + sinθ ẑ,   dω = cosθ dθ dφ,
// and with c = n_xy·d its cosine to the normal is
//     n·ω = c cosθ + n_z sinθ.
// It is positive above the tangent plane's elevation, tanθ₀ = −c/n_z. All integrals below have n_z ≥ 0.
//
// Elevations come as sine and cosine, so that no inverse function is needed but for one arctangent.

namespace heightlight {
namespace {

/// 1 − sinθ without cancellation towards the zenith, where cos²θ keeps the digits.
double one_minus_sine(const Elevation& elevation) {
  return elevation.sine > 0 ? elevation.cosine * elevation.cosine / (1 + elevation.sine) : 1 - elevation.sine;
}

}  // namespace

Elevation elevation_of_slope(double slope) {
  if (std::isinf(slope)) return {0, std::copysign(1.0, slope)};
  const double cosine = 1 / std::hypot(1.0, slope);
  return {cosine, slope * cosine};
}

double tangent_slope(const SliceNormal& normal) {
  return normal.along == 0 ? 0.0 : -normal.along / normal.up;
}

// The antiderivative of (c cosθ + n_z sinθ) cosθ is c/2 (θ + sinθ cosθ) + n_z/2 sin²θ. Between a and b, with
// δ = b − a and σ = a + b,
//     sin b cos b − sin a cos a = sinδ cosσ,   sin²b − sin²a = sinδ sinσ,
// so that the mass is (sinδ (c cosσ + n_z sinσ) + c δ) / 2: short intervals cost no digits.
double cosine_mass(const SliceNormal& normal, const Elevation& from, const Elevation& to) {
  const double sine_delta = to.sine * from.cosine - to.cosine * from.sine;
  const double cosine_delta = to.cosine * from.cosine + to.sine * from.sine;
  const double sine_sigma = to.sine * from.cosine + to.cosine * from.sine;
  const double cosine_sigma = to.cosine * from.cosine - to.sine * from.sine;
  const double delta = std::atan2(sine_delta, cosine_delta);
  return 0.5 * (sine_delta * (normal.along * cosine_sigma + normal.up * sine_sigma) + normal.along * delta);
}

double solid_angle_above(const Elevation& from) { return one_minus_sine(from); }

// With s = sin a, e = 1 − s, up to the zenith:
//     ∫ cos³θ dθ = 2/3 − s + s³/3 = e² (2 + s)/3,   ∫ sinθ cos²θ dθ = cos³a / 3,
//     ∫ sin²θ cosθ dθ = (1 − s³)/3 = e (1 + s + s²)/3.
Eigen::Vector2d bent_mass_above(const SliceNormal& normal, const Elevation& from) {
  const double s = from.sine;
  const double e = one_minus_sine(from);
  const double cubed_cosine = e * e * (2 + s) / 3;
  const double mixed = from.cosine * from.cosine * from.cosine / 3;
  const double squared_sine = e * (1 + s + s * s) / 3;
  return {normal.along * cubed_cosine + normal.up * mixed, normal.along * mixed + normal.up * squared_sine};
}

}  // namespace heightlight
