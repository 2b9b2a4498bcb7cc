#pragma once

#include <cstdint>

#include "heightlight/image.h"
#include "heightmap/synth_noise.h"

// The heightmaps behind synthesize(). Each function takes the size, and the seed where it matters, and
// returns heights as described in heightlight/synth.h. The natural ones are not yet stretched to [0, 1].

namespace heightlight::synth {

Image<float> flat(int size);
Image<float> plane(int size);
Image<float> bowl(int size);
Image<float> trench(int size);
Image<float> groove(int size);
Image<float> cliff(int size);
Image<float> steps(int size);
Image<float> sines(int size);
Image<float> solids(int size);

Image<float> fbm(int size, std::uint64_t seed);
Image<float> fbm_rows(const Rows& rows, std::uint64_t seed);
Image<float> cobbles(int size, std::uint64_t seed);
Image<float> brick(int size, std::uint64_t seed);
Image<float> concrete(int size, std::uint64_t seed);

}  // namespace heightlight::synth
