#pragma once

#include <cstdint>
#include <vector>

#include "base/hash.h"
#include "base/parallel.h"
#include "heightlight/image.h"

// Periodic noise that uses only integer hashes, the four exactly rounded operations and the square root, so
// that every machine makes the same map. Coordinates are in map widths; everything repeats with period 1.

namespace heightlight::synth {

inline std::uint64_t hash_cell(int x, int y, std::uint64_t seed) {
  return scramble(seed ^ (static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) << 32 |
                          static_cast<std::uint32_t>(x)));
}

/// A sequence of uniform random numbers.
class RandomSequence {
 public:
  explicit RandomSequence(std::uint64_t seed) : state_(seed) {}
  double unit() { return unit_real(scramble(state_++)); }
  double between(double low, double high) { return low + (high - low) * unit(); }

 private:
  std::uint64_t state_;
};

/// ⌊x⌋ for |x| < 2³¹. The library's floor is a function call where the processor's rounding instruction may
/// not be assumed.
inline int floor_to_int(double x) {
  const int truncated = static_cast<int>(x);
  return x < truncated ? truncated - 1 : truncated;
}

/// A difference of positions, taken across the map's edge where that is shorter: in [−½, ½).
inline double shorter_way(double difference) { return difference - floor_to_int(difference + 0.5); }

/// 0 below `low`, 1 above `high`, smooth between.
inline double smoothstep(double low, double high, double x) {
  const double t = (x - low) / (high - low);
  if (t <= 0) return 0;
  if (t >= 1) return 1;
  return t * t * (3 - 2 * t);
}

/// The larger of two heights, with their crease rounded over `radius`.
inline double smooth_max(double a, double b, double radius) {
  const double gap = radius - (a > b ? a - b : b - a);
  const double rounding = gap > 0 ? gap * gap / (4 * radius) : 0;
  return (a > b ? a : b) + rounding;
}

/// Gradient noise (Perlin 2002, quintic fade) on a lattice of `frequency_x` × `frequency_y` cells per period,
/// shifted by a fraction of a cell so that octaves do not share their zeros. Mean 0, standard deviation 0.28,
/// within ±1.6.
class TiledNoise {
 public:
  TiledNoise(int frequency_x, int frequency_y, std::uint64_t seed);
  double operator()(double u, double v) const;

 private:
  int frequency_x_;
  int frequency_y_;
  double shift_x_;
  double shift_y_;
  std::uint64_t seed_;
};

/// Octaves of TiledNoise. Their frequencies double from `first` on while they are at most `last`; their
/// amplitudes start at 1 and fall by the factor `persistence`. The first octave is always there.
class Octaves {
 public:
  Octaves(int first, int last, double persistence, std::uint64_t seed);
  double operator()(double u, double v) const;

 private:
  std::vector<TiledNoise> octaves_;
  double persistence_;
};

/// The spot at a position, if there is one.
struct Spot {
  double distance = 1;  ///< from the spot's centre, in units of its radius; 1 or more is outside
  double chance = 0;    ///< uniform random number of this spot, in [0, 1)
};

/// Round spots scattered over `frequency`² cells, each wholly inside a cell. A share `coverage` of the cells
/// has one.
class Spots {
 public:
  /// Radii range from `smallest` to `largest` (≤ ½) of a cell; small ones are more frequent.
  Spots(int frequency, double coverage, double smallest, double largest, std::uint64_t seed);
  Spot operator()(double u, double v) const;

 private:
  int frequency_;
  double coverage_;
  double smallest_;
  double largest_;
  std::uint64_t seed_;
};

/// Rows of an image of `size` × `size` texels.
struct Rows {
  int size = 0;
  int first = 0;
  int count = 0;
};

/// Returns these rows of the image of height(u, v), sampled at the texel centres.
template <class Height>
Image<float> sample_rows(const Rows& rows, const Height& height) {
  Image<float> image(rows.size, rows.count);
  parallel_for(rows.count, [&](std::int64_t i) {
    const int row = static_cast<int>(i);
    for (int column = 0; column < rows.size; ++column) {
      image(row, column) =
          static_cast<float>(height((column + 0.5) / rows.size, (rows.first + row + 0.5) / rows.size));
    }
  });
  return image;
}

/// Returns all rows of the image.
template <class Height>
Image<float> sample(int size, const Height& height) {
  return sample_rows({.size = size, .first = 0, .count = size}, height);
}

}  // namespace heightlight::synth
