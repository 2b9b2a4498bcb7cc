#include "visibility/slice_integrals.h"

#include <algorithm>
#include <cmath>

// A hemisphere in slices: at azimuth d (a unit vector in the horizontal plane) and elevation θ the direction
// is
//     ω(θ) = cosθ d + sinθ ẑ,   dω = cosθ dθ dφ,
// and with c = n_xy·d its cosine to the normal is
//     n·ω = c cosθ + n_z sinθ.
// It is positive above the tangent plane's elevation, tanθ₀ = −c/n_z. All integrals below have n_z ≥ 0.
//
// Elevations are given as sine and cosine: near the zenith the small cosine keeps the digits that the angle
// loses.

namespace heightlight {
namespace {

/// 1 − sinθ without cancellation towards the zenith, where cos²θ keeps the digits.
double one_minus_sine(const Elevation& elevation) {
  return elevation.sine > 0 ? elevation.cosine * elevation.cosine / (1 + elevation.sine) : 1 - elevation.sine;
}

/// δ − sinδ for 0 ≤ δ ≤ π/2. For small δ it is summed as the series of arcsin s − s, the next term of which
/// is below 10⁻¹⁵ of the sum.
double angle_minus_sine(double sine, double cosine) {
  if (sine > 0.1) return std::atan2(sine, cosine) - sine;
  constexpr double kSeries[] = {135135.0 / 9676800, 10395.0 / 599040, 945.0 / 42240, 105.0 / 3456,
                                15.0 / 336,         3.0 / 40,         1.0 / 6};
  const double squared = sine * sine;
  double sum = 0;
  for (const double term : kSeries) sum = sum * squared + term;
  return sum * squared * sine;
}

/// On the tangent plane, rounding may leave the cosine slightly below 0.
double clamp_cosine(double cosine) { return std::max(cosine, 0.0); }

}  // namespace

Elevation elevation_of_slope(double slope) {
  if (std::isinf(slope)) return {0, std::copysign(1.0, slope)};
  const double cosine = 1 / std::sqrt(1 + slope * slope);
  return {cosine, slope * cosine};
}

double tangent_slope(const SliceNormal& normal) {
  return normal.along == 0 ? 0.0 : -normal.along / normal.up;
}

// The antiderivative of (c cosθ + n_z sinθ) cosθ is c/2 (θ + sinθ cosθ) + n_z/2 sin²θ. Between a and b, with
// δ = b − a and σ = a + b,
//     sin b cos b − sin a cos a = sinδ cosσ,   sin²b − sin²a = sinδ sinσ,
// so that the mass is
//     (sinδ (c cosσ + n_z sinσ) + c δ) / 2.
// In a deep shaft, where n_z and the cosines of a and b are small, these terms are far larger than their sum.
// With p = cos a + cos b and q = sin a + sin b, which give 1 + cosσ = p²/(1 + cosδ) and sinσ = p q/(1 +
// cosδ), the same is
//     (sinδ/(1 + cosδ) p (c p + n_z q) + c (δ − sinδ)) / 2,
// where p keeps the digits. This form is used up to δ = π/2. Wider intervals begin below the horizontal, and
// for them nothing cancels in the first form.
double cosine_mass(const SliceNormal& normal, const Elevation& from, const Elevation& to) {
  const double c = normal.along;
  const double sine_delta = to.sine * from.cosine - to.cosine * from.sine;
  const double cosine_delta = to.cosine * from.cosine + to.sine * from.sine;
  if (cosine_delta < 0) {
    const double sine_sigma = to.sine * from.cosine + to.cosine * from.sine;
    const double cosine_sigma = to.cosine * from.cosine - to.sine * from.sine;
    const double delta = std::atan2(sine_delta, cosine_delta);
    return 0.5 * (sine_delta * (c * cosine_sigma + normal.up * sine_sigma) + c * delta);
  }
  const double p = from.cosine + to.cosine;
  const double q = from.sine + to.sine;
  const double half_tangent = sine_delta / (1 + cosine_delta);
  return 0.5 * (half_tangent * p * (c * p + normal.up * q) + c * angle_minus_sine(sine_delta, cosine_delta));
}

void SkyShareSum::add(const SliceNormal& normal, double horizon_slope) {
  const double tangent = tangent_slope(normal);
  whole_ += cosine_mass(normal, elevation_of_slope(tangent), {});
  open_ += cosine_mass(normal, elevation_of_slope(std::max(tangent, horizon_slope)), {});
}

// Let v = (1 − t) ω_a + t ω_b run over the chord between the directions to the ends, A = |A| ω_a and B = |B|
// ω_b. Then dθ = sinδ dt/|v|², so that the weight is
//     (n·ω) cosθ dθ ∝ (n·v) v_d dt/|v|⁴,
// and v meets the stretch A + λ (B − A) where the cross product of both is 0,
//     t |A| (1 − λ) = (1 − t) |B| λ,   λ = t/(t + (1 − t) |B|/|A|).
// No term is negative, so that the mean stays on the stretch, whatever the rounding.
double mean_share(const SliceNormal& normal, const Elevation& from, const Elevation& to, double from_way,
                  double to_way) {
  constexpr double kNode[] = {0.1127016653792583, 0.5, 0.8872983346207417};  // Gauss–Legendre on [0, 1]
  constexpr double kWeight[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  const double cosine_from = clamp_cosine(normal.along * from.cosine + normal.up * from.sine);
  const double cosine_to = clamp_cosine(normal.along * to.cosine + normal.up * to.sine);
  const double distance_ratio = to_way * from.cosine / (from_way * to.cosine);
  double weights = 0;
  double weighted = 0;
  for (int i = 0; i < 3; ++i) {
    const double t = kNode[i];
    const double along = (1 - t) * from.cosine + t * to.cosine;
    const double up = (1 - t) * from.sine + t * to.sine;
    const double squared = along * along + up * up;
    const double weight = kWeight[i] * ((1 - t) * cosine_from + t * cosine_to) * along / (squared * squared);
    weights += weight;
    weighted += weight * t / (t + (1 - t) * distance_ratio);
  }
  return weights > 0 ? weighted / weights : 0.5;
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

// With k = cos a and ζ = δ − s k, δ = π/2 − a,
//     ∫ cos⁴θ dθ = 3/8 ζ − s k³/4,   ∫ sinθ cos³θ dθ = k⁴/4,   ∫ sin²θ cos²θ dθ = ζ/8 + s k³/4.
Eigen::Vector2d second_mass_above(const SliceNormal& normal, const Elevation& from) {
  const double s = from.sine;
  const double k = from.cosine;
  const double zenith = std::atan2(k, s) - s * k;
  const double fourth = k * k * k * k / 4;
  const double tilted = s * k * k * k / 4;
  return {normal.along * (0.375 * zenith - tilted) + normal.up * fourth,
          normal.along * fourth + normal.up * (zenith / 8 + tilted)};
}

}  // namespace heightlight
