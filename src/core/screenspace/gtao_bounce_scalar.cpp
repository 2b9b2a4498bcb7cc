#include <cmath>
#include <numbers>

#include "screenspace/gtao_bounce_kernel.h"

namespace heightlight {
namespace {

float slice_irradiance(float c, float n_z, float m) {
  constexpr float kHalfPi = std::numbers::pi_v<float> / 2;
  const float q = 1 / (1 + m * m);
  return c * (kHalfPi - std::atan(m) - m * q) + n_z * q;
}

}  // namespace

void gather_slices_scalar(const BounceSlicePass& pass, int row, SeenSums& sums) {
  const DepthBuffer& depth = pass.depth;
  for (int column = 0; column < depth.width; ++column) {
    const std::size_t at = depth.index(row, column);
    const auto j = static_cast<std::size_t>(column);
    const float n_z = depth.normal_z[at];
    for (const Slice& slice : pass.tables.table(row, column % DepthBuffer::kPhases)) {
      for (std::size_t side = 0; side < 2; ++side) {
        const float sign = side == 0 ? -1.0F : 1.0F;
        float horizon = sign * (depth.slope_x[at] * slice.x + depth.slope_y[at] * slice.y);
        const float c = -n_z * horizon;
        const float open = slice_irradiance(c, n_z, horizon);
        float above = open;
        float before = pass.radiance[at];
        for (const SliceSample& sample : slice.sides[side]) {
          float slope = 0;
          float radiance = 0;
          for (int i = 0; i < pass.tables.taps; ++i) {
            const DepthTap& tap = sample.taps[static_cast<std::size_t>(i)];
            const std::size_t there = depth.index((row + tap.row) % depth.period_rows,
                                                  (column + tap.column) % depth.period_columns);
            slope += tap.weight * (depth.heights[there] - depth.heights[at]);
            radiance += tap.weight * sample.distance * pass.radiance[there];
          }
          if (slope > horizon) {
            const float rest = slice_irradiance(c, n_z, slope);
            sums.light[j] += (above - rest) * 0.5F * (before + radiance);
            above = rest;
            horizon = slope;
          }
          before = radiance;
        }
        sums.hidden[j] += open - above;
      }
    }
  }
}

}  // namespace heightlight
