#pragma once

#include <algorithm>

#include "heightlight/surface.h"
#include "window/window_surface.h"

namespace heightlight {

/// A map in memory, read as if it were elsewhere.
class HeldMap : public StoredMap {
 public:
  explicit HeldMap(const Map& map) : map_(map) {}
  int width() const override { return map_.width; }
  int height() const override { return map_.height; }
  void read(const MapRect& rect, float* samples) const override {
    for (int i = 0; i < rect.rows; ++i)
      std::copy_n(&map_(rect.first_row + i, rect.first_column), rect.columns, samples + i * rect.columns);
  }

 private:
  const Map& map_;
};

/// The level of a map's heights that its windows make.
inline CoarseHeights coarse_heights(const StoredMap& heights, Boundary boundary, int level, int window) {
  const int side = 1 << level;
  const auto blocks = [side](int samples) { return (samples + side - 1) / side; };
  HeightPyramid::Level whole{Map(blocks(heights.width()), blocks(heights.height())),
                             Map(blocks(heights.width()), blocks(heights.height()))};
  for (int row = 0; row < heights.height(); row += window) {
    for (int column = 0; column < heights.width(); column += window) {
      const WindowPlace place{heights.width(),
                              heights.height(),
                              row,
                              column,
                              std::min(window, heights.width() - column),
                              std::min(window, heights.height() - row)};
      const HeightPyramid::Level part = coarse_heights_of(heights, boundary, place, level);
      for (int i = 0; i < part.mean.height; ++i) {
        for (int j = 0; j < part.mean.width; ++j) {
          whole.mean(row / side + i, column / side + j) = part.mean(i, j);
          whole.highest(row / side + i, column / side + j) = part.highest(i, j);
        }
      }
    }
  }
  return complete_heights(level, std::move(whole));
}

/// A surface by its parts. All arguments must outlive it.
inline MapParts parts_of(const Surface& surface, const StoredMap& heights, const CoarseHeights& coarse) {
  return {.heights = heights,
          .base = surface.map.base,
          .spacing = surface.map.spacing,
          .boundary = surface.map.boundary,
          .curvature = surface.map.curvature,
          .lowest = surface.lowest,
          .highest = surface.highest,
          .coarse = coarse};
}

}  // namespace heightlight
