#pragma once

#include <vector>

#include "heightlight/surface.h"

namespace heightlight {

/// Heights over square blocks of samples, for what a receiver sees from afar. Level l covers blocks of 2^l ×
/// 2^l samples, ⌈width / 2^l⌉ × ⌈height / 2^l⌉ of them. The last level is one block. Samples that bound no
/// facet stand in nobody's way, and count as missing. Heights are relative to the map's base, like the map's
/// own; kNoHeight where a block holds no sample.
struct HeightPyramid {
  struct Level {
    Image<float> mean;
    Image<float> highest;
  };
  std::vector<Level> levels;  ///< levels[l − 1] is level l
  Image<float> occluders;     ///< level 0; empty where it is the map itself

  const Image<float>& level_0(const Surface& surface) const {
    return occluders.values.empty() ? surface.map.height : occluders;
  }
};

/// Below everything, and finite, so that a weight of zero takes it away.
constexpr float kNoHeight = -1e30F;

/// Bytes that build_height_pyramid takes for a map of that size.
std::uint64_t height_pyramid_bytes(int width, int height);

/// Those of a window of a larger map are in its Surroundings: it has none here.
HeightPyramid build_height_pyramid(const Surface& surface);

/// The level above one, whose blocks hold means and highest heights; level 0 has its samples for both, NaN
/// where missing.
HeightPyramid::Level coarsen_heights(const Image<float>& mean, const Image<float>& highest);

}  // namespace heightlight
