#include <algorithm>
#include <cmath>

#include "screenspace/hbao_kernel.h"

namespace heightlight {
namespace {

/// What one side hides from the receiver at (row, column). Only what rises above its tangent plane counts.
float hidden_by(const HbaoPass& pass, const std::vector<SliceSample>& side, int row, int column,
                float tangent) {
  const DepthBuffer& depth = pass.depth;
  const float height = depth.heights[depth.index(row, column)];
  float horizon = tangent;
  float sine = tangent / std::sqrt(tangent * tangent + 1);
  float hidden = 0;
  for (const SliceSample& sample : side) {
    float slope = 0;
    for (int i = 0; i < pass.tables.taps; ++i) {
      const DepthTap& tap = sample.taps[static_cast<std::size_t>(i)];
      const std::size_t at =
          depth.index((row + tap.row) % depth.period_rows, (column + tap.column) % depth.period_columns);
      slope += tap.weight * (depth.heights[at] - height);
    }
    if (!(slope > horizon)) continue;
    const float squared_secant = slope * slope + 1;
    const float raised = slope / std::sqrt(squared_secant);
    const float far = sample.distance * sample.distance * pass.per_squared_radius * squared_secant;
    hidden += std::max(1 - far, 0.0F) * (raised - sine);
    horizon = slope;
    sine = raised;
  }
  return hidden;
}

}  // namespace

void hbao_row_scalar(const HbaoPass& pass, int row, std::vector<float>& open) {
  const DepthBuffer& depth = pass.depth;
  for (int column = 0; column < depth.width; ++column) {
    const std::size_t at = depth.index(row, column);
    for (const Slice& slice : pass.tables.table(row, column % DepthBuffer::kPhases)) {
      const float tangent = depth.slope_x[at] * slice.x + depth.slope_y[at] * slice.y;
      for (std::size_t side = 0; side < 2; ++side) {
        open[static_cast<std::size_t>(column)] +=
            1 - hidden_by(pass, slice.sides[side], row, column, side == 0 ? -tangent : tangent);
      }
    }
  }
}

}  // namespace heightlight
