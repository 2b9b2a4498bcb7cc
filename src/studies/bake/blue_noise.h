#pragma once

#include <cstdint>

#include "heightlight/image.h"

namespace heightlight {

/// A square of thresholds (rank + ½)/side² in (0, 1), each once, that tiles and whose every level set is
/// spread evenly (void and cluster, Ulichney 1993: energies of a Gaussian, σ = 1.5, wrapped). The same for
/// the same seed. side ≥ 4.
Image<float> make_blue_noise(int side, std::uint64_t seed);

/// Texels on a side of the square that dithering repeats.
constexpr int kDitherSide = 64;

}  // namespace heightlight
