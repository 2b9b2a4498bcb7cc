#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/hash.h"
#include "heightlight/heightmap.h"
#include "heightlight/synth.h"

namespace heightlight {

/// A map of one world unit's width with heights by a function of (row, column).
template <class Function>
Heightmap make_map(int width, int height, Boundary boundary, Function&& height_at) {
  Heightmap map;
  map.height = Image<float>(width, height);
  map.spacing = {1.0 / width, 1.0 / width};
  map.boundary = boundary;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column)
      map.height(row, column) = static_cast<float>(height_at(row, column));
  }
  return map;
}

/// Independent heights in [0, relief]: every cell is a cliff. A share of the samples is missing.
inline Heightmap make_rough_map(int width, int height, Boundary boundary, double relief, double missing_share,
                                std::uint64_t seed) {
  return make_map(width, height, boundary, [&](int row, int column) {
    const std::uint64_t hash = hash_combine(seed, static_cast<std::uint64_t>(row * 65536 + column));
    if (unit_real(hash) < missing_share) return std::numeric_limits<double>::quiet_NaN();
    return relief * unit_real(scramble(hash));
  });
}

/// A shape of the project's own, with heights from 0 to `relief`.
inline Heightmap make_synth_map(const char* shape, int size, Boundary boundary, double relief) {
  const Image<float> unit = synthesize(shape, size, 1);
  return make_map(size, size, boundary,
                  [&](int row, int column) { return relief * double{unit(row, column)}; });
}

/// The map moved by whole texels around its torus.
inline Heightmap shift_map(const Heightmap& map, int rows, int columns) {
  Heightmap shifted = map;
  const int width = map.height.width;
  const int height = map.height.height;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      shifted.height((row + rows) % height, (column + columns) % width) = map.height(row, column);
    }
  }
  return shifted;
}

}  // namespace heightlight
