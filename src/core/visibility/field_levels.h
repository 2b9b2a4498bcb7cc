#pragma once

#include <cstddef>

#include "heightlight/image.h"

namespace heightlight {

/// Blocks of one level of a field, wherever they are stored.
struct FieldView {
  float* origin = nullptr;
  std::ptrdiff_t stride = 0;
  int width = 0;
  int height = 0;
};

inline FieldView view_of(Map& map) { return {map.values.data(), map.width, map.width, map.height}; }

/// Fills `coarse` with the means of 2 × 2 blocks of `fine`. A mean counts only the blocks that are not NaN,
/// and is NaN where there is none. Where the number of rows or columns is odd, the last means are over the
/// blocks that exist. `coarse` has half as many rows and columns as `fine`, rounded up.
void coarsen_field(const FieldView& fine, const FieldView& coarse);

/// Gives blocks that are NaN the value of the block around them: `coarse` is the level above, in which a
/// block of `fine` lies at half its row and column. Without `coarse` (null) such blocks become 0.
void fill_field_holes(const FieldView& fine, const FieldView* coarse);

}  // namespace heightlight
