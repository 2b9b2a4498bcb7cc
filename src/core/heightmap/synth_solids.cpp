#include <algorithm>
#include <cmath>

#include "heightmap/synth_noise.h"
#include "heightmap/synth_shapes.h"

// The notes' first scene (Patapom, "Showtime"): solids on a floor, which rise up to 0.45 map widths. Round
// solids are truly round at that relief.

namespace heightlight::synth {
namespace {

constexpr double kRelief = 0.45;  // map widths

double square(double x) { return x * x; }

/// Heights above the floor, in map widths, of a solid about the origin.
double box(double x, double y, double half, double height) {
  return std::max(std::abs(x), std::abs(y)) < half ? height : 0;
}

double cylinder(double x, double y, double radius, double height) {
  return square(x) + square(y) < square(radius) ? height : 0;
}

double hemisphere(double x, double y, double radius) {
  return std::sqrt(std::max(0.0, square(radius) - square(x) - square(y)));
}

double cone(double x, double y, double radius, double height) {
  return std::max(0.0, height * (1 - std::sqrt(square(x) + square(y)) / radius));
}

double pyramid(double x, double y, double half, double height) {
  return std::max(0.0, height * (1 - std::max(std::abs(x), std::abs(y)) / half));
}

/// The upper half of a ring of round section.
double half_torus(double x, double y, double radius, double thickness) {
  return std::sqrt(std::max(0.0, square(thickness) - square(std::sqrt(square(x) + square(y)) - radius)));
}

/// An upright ring wall around an open middle.
double well(double x, double y, double outer, double inner, double height) {
  return cylinder(x, y, outer, height) - cylinder(x, y, inner, height);
}

double stairs(double x, double y, double half, double height) {
  if (std::max(std::abs(x), std::abs(y)) >= half) return 0;
  constexpr double kTreads = 4;
  return height * (1 + std::floor((x + half) / (2 * half) * kTreads)) / kTreads;
}

}  // namespace

// Nine solids in the cells of a 3 × 3 board, each about its cell's middle (x, y), lengths in map widths:
//   box 0.22 × 0.22 × 0.25,         hemisphere of radius 0.13,      cylinder of radius 0.08 and height 0.45,
//   cone of radius 0.13, 0.3 high,  well 0.24 wide with walls 0.05, pyramid 0.26 × 0.26 × 0.32,
//                                   0.22 high,
//   stairs of four treads, 0.2,     ring of radius 0.1, thickness   box 0.1 × 0.1 × 0.45.
//                                   0.04,
Image<float> solids(int size) {
  return sample(size, [](double u, double v) {
    const int column = std::min(2, static_cast<int>(3 * u));
    const int row = std::min(2, static_cast<int>(3 * v));
    const double x = u - (column + 0.5) / 3;
    const double y = v - (row + 0.5) / 3;
    switch (3 * row + column) {
      case 0:
        return box(x, y, 0.11, 0.25) / kRelief;
      case 1:
        return hemisphere(x, y, 0.13) / kRelief;
      case 2:
        return cylinder(x, y, 0.08, kRelief) / kRelief;
      case 3:
        return cone(x, y, 0.13, 0.3) / kRelief;
      case 4:
        return well(x, y, 0.12, 0.07, 0.22) / kRelief;
      case 5:
        return pyramid(x, y, 0.13, 0.32) / kRelief;
      case 6:
        return stairs(x, y, 0.12, 0.2) / kRelief;
      case 7:
        return half_torus(x, y, 0.1, 0.04) / kRelief;
      default:
        return box(x, y, 0.05, kRelief) / kRelief;
    }
  });
}

}  // namespace heightlight::synth
