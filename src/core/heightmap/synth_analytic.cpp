#include <algorithm>
#include <cmath>
#include <numbers>

#include "heightmap/synth_noise.h"
#include "heightmap/synth_shapes.h"

namespace heightlight::synth {
namespace {

// sin 2πt. The library's sine may differ in its last bit between machines; this one does not. The argument is
// folded to a quarter turn, where the Taylor series to x²¹ leaves (π/2)²³/23! ≈ 1e-18.
double sine_of_turns(double t) {
  t -= std::floor(t + 0.5);
  if (t > 0.25) t = 0.5 - t;
  if (t < -0.25) t = -0.5 - t;
  const double x = 2 * std::numbers::pi * t;
  double sum = 1;
  for (int n = 20; n >= 2; n -= 2) sum = 1 - x * x / (n * (n + 1)) * sum;
  return x * sum;
}

}  // namespace

// h = 0
Image<float> flat(int size) { return Image<float>(size, size); }

// h = u
Image<float> plane(int size) {
  return sample(size, [](double u, double) { return u; });
}

// A spherical cap. Its rim, at the level h = 1, has radius r = 0.35 about the centre of the map, and its
// depth is A = 0.25, in map widths; so the sphere's radius is R = (r² + A²)/(2A) = 0.37. At the distance ρ
// from the centre, inside the rim,
//   A h = R − √(R² − ρ²),
// and h = 1 outside. The cap is spherical only at a relief of a quarter of the width.
Image<float> bowl(int size) {
  constexpr double kRim = 0.35;
  constexpr double kDepth = 0.25;
  constexpr double kRadius = (kRim * kRim + kDepth * kDepth) / (2 * kDepth);
  return sample(size, [](double u, double v) {
    const double squared = (u - 0.5) * (u - 0.5) + (v - 0.5) * (v - 0.5);
    if (squared >= kRim * kRim) return 1.0;
    // The same difference, without the cancellation near the centre.
    return squared / (kRadius + std::sqrt(kRadius * kRadius - squared)) / kDepth;
  });
}

// h = 0 where |u − ½| < ⅛, else 1: a trench that runs up the image. Its walls lie between two columns of
// texels, so that at half height it is a quarter of the map wide if the size is a multiple of 8; the floor is
// one texel narrower.
Image<float> trench(int size) {
  return sample(size, [](double u, double) { return std::abs(u - 0.5) < 0.125 ? 0.0 : 1.0; });
}

// h = min(1, 4 |u − ½|): a V that runs up the image, half of the map wide at its top.
Image<float> groove(int size) {
  return sample(size, [](double u, double) { return std::min(1.0, 4 * std::abs(u - 0.5)); });
}

// h = 0 where u < ½, else 1: the wall lies between two columns of texels.
Image<float> cliff(int size) {
  return sample(size, [](double u, double) { return u < 0.5 ? 0.0 : 1.0; });
}

// h = ⌊8u⌋ / 7: eight treads, rising to the right.
Image<float> steps(int size) {
  return sample(size, [](double u, double) { return std::floor(8 * u) / 7; });
}

// s = sin 2π(2u + v) + 0.7 sin(2π(−3u + 4v) + 1.3) + 0.5 sin(2π(7u + 5v) + 0.4) + 0.3 sin(2π(−11u + 13v)
// + 2.1), h = (s + 2.5)/5. The amplitudes sum to 2.5, so h lies inside [0, 1] and does not quite reach its
// ends.
Image<float> sines(int size) {
  return sample(size, [](double u, double v) {
    constexpr double kRadian = 0.5 / std::numbers::pi;
    const double s = sine_of_turns(2 * u + v) + 0.7 * sine_of_turns(-3 * u + 4 * v + 1.3 * kRadian) +
                     0.5 * sine_of_turns(7 * u + 5 * v + 0.4 * kRadian) +
                     0.3 * sine_of_turns(-11 * u + 13 * v + 2.1 * kRadian);
    return (s + 2.5) / 5;
  });
}

}  // namespace heightlight::synth
