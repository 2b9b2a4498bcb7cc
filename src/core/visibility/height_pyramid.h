#pragma once

#include <vector>

#include "heightlight/surface.h"

namespace heightlight {

/// Heights over square blocks of samples, for what a receiver sees from afar. Level l covers the map with
/// ⌈width / 2^l⌉ × ⌈height / 2^l⌉ blocks of 2^l × 2^l samples. The last level is one block. Samples that
/// bound no facet occlude nothing and count as missing. Heights are relative to the map's base, like the
/// map's own. They are kNoHeight where a block holds no sample.
struct HeightPyramid {
  struct Level {
    Image<float> mean;
    Image<float> highest;
  };
  std::vector<Level> levels;  ///< levels[l − 1] is level l
  Image<float> occluders;     ///< level 0; empty where level 0 is the map itself

  const Image<float>& level_0(const Surface& surface) const {
    return occluders.values.empty() ? surface.map.height : occluders;
  }
};

/// A height below everything. It is finite, so that a weight of zero cancels it.
constexpr float kNoHeight = -1e30F;

/// Bytes that build_height_pyramid takes for a map of that size.
std::uint64_t height_pyramid_bytes(int width, int height);

/// Builds the pyramid of a whole map. A window of a larger map gets an empty one: its heights are in its
/// Surroundings.
HeightPyramid build_height_pyramid(const Surface& surface);

/// Makes the next coarser level, whose blocks hold means and highest heights. For level 1, `mean` and
/// `highest` are both the samples, NaN where missing.
HeightPyramid::Level coarsen_heights(const Image<float>& mean, const Image<float>& highest);

}  // namespace heightlight
