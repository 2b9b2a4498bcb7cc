#pragma once

#include <cstddef>

#include "heightlight/image.h"

namespace heightlight {

/// Blocks of one level of a field, wherever they lie.
struct FieldView {
  float* origin = nullptr;
  std::ptrdiff_t stride = 0;
  int width = 0;
  int height = 0;
};

inline FieldView view_of(Map& map) { return {map.values.data(), map.width, map.width, map.height}; }

/// The means of 2 × 2 blocks, of those that are there; NaN where none is. The last of an odd number of rows
/// or columns are the means of what they have. `coarse` has half as many, rounded up.
void coarsen_field(const FieldView& fine, const FieldView& coarse);

/// Blocks that are NaN take the value of the block around them: `coarse` is the level above, in which a block
/// of `fine` lies at half its row and column. Where there is none, they take 0.
void fill_field_holes(const FieldView& fine, const FieldView* coarse);

}  // namespace heightlight
