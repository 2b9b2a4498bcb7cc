#include <algorithm>
#include <cmath>

#include "heightmap/synth_noise.h"
#include "heightmap/synth_shapes.h"

// The notes' second scene (Patapom, "Showtime"): rough concrete, meant for a relief of 0.05 of the width. It
// was cast against four boards. Their seams stand out where paste ran between the boards, bubbles left holes,
// and aggregate shows where the skin is worn away. Lengths are in map widths, heights are shares of the
// relief.

namespace heightlight::synth {
namespace {

constexpr int kBoards = 4;

class Casting {
 public:
  Casting(int size, std::uint64_t seed)
      : seed_(hash_combine(seed, 50)),
        waves_(2, 16, 0.5, hash_combine(seed, 51)),
        skin_(40, size / 2, 0.6, hash_combine(seed, 52)),
        wear_(5, 40, 0.6, hash_combine(seed, 53)),
        large_holes_(9, 0.4, 0.1, 0.4, hash_combine(seed, 54)),
        holes_(31, 0.3, 0.08, 0.4, hash_combine(seed, 55)),
        stones_(26, 0.9, 0.3, 0.5, hash_combine(seed, 56)),
        pebbles_(61, 0.9, 0.3, 0.5, hash_combine(seed, 57)) {}

  double height(double u, double v) const {
    double h = 0.7 + 0.1 * waves_(u, v) + board(u, v) + 0.018 * skin_(u, v);
    const double worn = smoothstep(0.12, 0.4, wear_(u, v));
    h += worn * (aggregate(u, v) - 0.16);
    return h - hole(large_holes_(u, v), 0.6) - hole(holes_(u, v), 0.3);
  }

 private:
  /// A board's own level, and the fins between boards.
  double board(double u, double v) const {
    const double along = v * kBoards;
    const int number = floor_to_int(along);
    const double level = RandomSequence(hash_cell(0, number % kBoards, seed_)).between(-0.03, 0.03);
    const double place = along - number;
    const double seam = std::min(place, 1 - place) / kBoards + 0.002 * skin_(v, u);
    return level + 0.1 * smoothstep(0.012, 0.0, seam);
  }

  /// Stones and pebbles in the worn places.
  double aggregate(double u, double v) const {
    double h = 0;
    for (const auto& [spot, tall] : {std::pair{stones_(u, v), 0.2}, std::pair{pebbles_(u, v), 0.11}}) {
      if (spot.distance < 1) h = std::max(h, tall * std::sqrt(1 - spot.distance * spot.distance));
    }
    return h;
  }

  /// Bubbles: round, some of them deep.
  static double hole(const Spot& spot, double depth) {
    if (spot.distance >= 1) return 0;
    return depth * (0.3 + 0.7 * spot.chance) * std::sqrt(1 - spot.distance * spot.distance);
  }

  std::uint64_t seed_;
  Octaves waves_, skin_, wear_;
  Spots large_holes_, holes_, stones_, pebbles_;
};

}  // namespace

Image<float> concrete(int size, std::uint64_t seed) {
  const Casting casting(size, seed);
  return sample(size, [&](double u, double v) { return casting.height(u, v); });
}

}  // namespace heightlight::synth
