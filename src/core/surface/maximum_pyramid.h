#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "heightlight/surface.h"

namespace heightlight {

/// Upper bounds of the surface over square blocks of cells. Level 0 holds each cell's highest vertex, level l
/// blocks of 2^l × 2^l cells, up to one block for the whole map. A row of level l has `stride >> l` entries,
/// a power of two, so that an index costs shifts only. Missing samples bound nothing (−∞ where a block has no
/// other).
struct MaximumPyramid {
  static constexpr int kMostLevels = 32;

  int levels = 0;                                  ///< ≥ 1
  int stride_bits = 0;                             ///< log2 of level 0's stride
  std::array<std::int32_t, kMostLevels> offset{};  ///< of each level's first entry
  std::vector<float> highest;

  std::int32_t index(int level, int cell_row, int cell_column) const {
    return offset[static_cast<std::size_t>(level)] + ((cell_row >> level) << (stride_bits - level)) +
           (cell_column >> level);
  }
};

/// Bytes that build_maximum_pyramid takes for such a surface.
std::uint64_t maximum_pyramid_bytes(int cell_columns, int cell_rows);

/// Needs at least one cell; throws Error when the entries pass 2³¹.
MaximumPyramid build_maximum_pyramid(const Surface& surface);

/// The levels from `first` on, by that of the blocks of `first`: at least as many as so many cells have.
MaximumPyramid complete_maximum_pyramid(int first, const Map& blocks, int cell_columns, int cell_rows);

}  // namespace heightlight
