#include "heightmap/synth_noise.h"
#include "heightmap/synth_shapes.h"

namespace heightlight::synth {

// Fractional Brownian motion: Σ 2⁻ᵏ noise(4·2ᵏ) down to waves two texels long. The amplitude of a wave is
// proportional to its length (Hurst exponent 1), as in young mountains.
Image<float> fbm_rows(const Rows& rows, std::uint64_t seed) {
  const Octaves octaves(4, rows.size / 2, 0.5, hash_combine(seed, 1));
  return sample_rows(rows, octaves);
}

Image<float> fbm(int size, std::uint64_t seed) {
  return fbm_rows({.size = size, .first = 0, .count = size}, seed);
}

}  // namespace heightlight::synth
