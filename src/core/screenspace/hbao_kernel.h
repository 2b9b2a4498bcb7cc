#pragma once

#include <vector>

#include "heightlight/screenspace.h"
#include "screenspace/slice_samples.h"

// HBAO of one row of receivers. With slopes in place of angles, sin h = m/√(1 + m²), and a sample at the
// horizontal distance t under the slope m is at the distance r = t √(1 + m²). Starting from the slope of the
// tangent plane, each sample that is steeper than all before it adds (1 − r²/R²)(sin h − sin h before).

namespace heightlight {

/// How the receivers of a row look around.
struct HbaoPass {
  const DepthBuffer& depth;
  const SliceTables& tables;
  float per_squared_radius = 0;  ///< 1/R²; 0 where nothing is attenuated
};

/// Adds to `open`, per receiver of the row, the sum of 1 − (sin h − sin t) over both sides of all slices,
/// with each sample's part of the difference attenuated. The readable version.
void hbao_row_scalar(const HbaoPass& pass, int row, std::vector<float>& open);

/// As hbao_row_scalar, vectorized over receivers four columns apart. The results differ only by the rounding
/// of fused products.
void hbao_row(const HbaoPass& pass, int row, std::vector<float>& open);

}  // namespace heightlight
