#pragma once

#include <vector>

#include "heightlight/screenspace.h"
#include "screenspace/slice_samples.h"

// HBAO of one row of receivers. With slopes in place of angles, sin h = m/√(1 + m²), a sample at the
// horizontal distance t under the slope m is r = t √(1 + m²) away. Starting from the tangent plane's slope, a
// sample that is steeper than all before it adds (1 − r²/R²)(sin h − sin h before).

namespace heightlight {

/// How rows are looked at.
struct HbaoPass {
  const DepthBuffer& depth;
  const SliceTables& tables;
  float per_squared_radius = 0;  ///< 1/R²; 0 where nothing is attenuated
};

/// Adds to `open`, per receiver of the row, the sum of 1 − (sin h − sin t) over both sides of all slices. The
/// readable one.
void hbao_row_scalar(const HbaoPass& pass, int row, std::vector<float>& open);

/// The fast one: receivers four apart side by side. The same, but for the rounding of fused products.
void hbao_row(const HbaoPass& pass, int row, std::vector<float>& open);

}  // namespace heightlight
