#include "visibility/field_levels.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/parallel.h"
#include "surface/blocks.h"

namespace heightlight {

void coarsen_field(const FieldView& fine, const FieldView& coarse) {
  assert(coarse.width == half_blocks(fine.width) && coarse.height == half_blocks(fine.height));
  parallel_for(coarse.height, [&](std::int64_t row) {
    float* out = coarse.origin + row * coarse.stride;
    const float* upper = fine.origin + 2 * row * fine.stride;
    const float* lower = 2 * row + 1 < fine.height ? upper + fine.stride : upper;
    for (int column = 0; column < coarse.width; ++column) {
      const int left = 2 * column;
      const int right = std::min(left + 1, fine.width - 1);
      const float all = 0.25F * (upper[left] + upper[right] + lower[left] + lower[right]);
      if (!std::isnan(all)) {
        out[column] = all;
        continue;
      }
      float sum = 0;
      int present = 0;
      for (const float part : {upper[left], upper[right], lower[left], lower[right]}) {
        if (std::isnan(part)) continue;
        sum += part;
        ++present;
      }
      out[column] = sum / static_cast<float>(present);
    }
  });
}

void fill_field_holes(const FieldView& fine, const FieldView* coarse) {
  parallel_for(fine.height, [&](std::int64_t row) {
    float* line = fine.origin + row * fine.stride;
    const float* parents = coarse ? coarse->origin + row / 2 * coarse->stride : nullptr;
    for (int column = 0; column < fine.width; ++column) {
      if (std::isnan(line[column])) line[column] = parents ? parents[column / 2] : 0;
    }
  });
}

}  // namespace heightlight
