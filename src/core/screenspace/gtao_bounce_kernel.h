#pragma once

#include <vector>

#include "heightlight/screenspace.h"
#include "screenspace/slice_samples.h"

// One bounce along GTAO's horizons, for one row of receivers. Let S(m) be twice a side's irradiance above the
// slope m (gtao_kernel.h). The surface between two successive horizons m < m' of a side then has the form
// factor (S(m) − S(m'))/2 over the number of slices. What comes into view between a sample and the one before
// it is given the mean radiance of the two. (With the radiance of the second alone, totals at albedo 0.8 come
// out too bright by 0.05 between bricks, where that sample is a lit top and what is seen is the wall below
// it.)

namespace heightlight {

/// Sums over the slices, per receiver in a row of the map.
struct SeenSums {
  std::vector<float> hidden;  ///< Σ S(tangent) − S(horizon): twice the visible surface's form factor
  std::vector<float> light;   ///< Σ (S(m) − S(m')) × mean radiance
};

struct BounceSlicePass {
  const DepthBuffer& depth;
  const SliceTables& tables;
  const std::vector<float>& radiance;  ///< like DepthBuffer::heights; finite everywhere
};

/// Adds to the sums of the row's receivers. The readable version.
void gather_slices_scalar(const BounceSlicePass& pass, int row, SeenSums& sums);

/// As gather_slices_scalar, vectorized over receivers four columns apart. The results differ only by the
/// rounding of fused products and of the arc tangent (2e-8).
void gather_slices(const BounceSlicePass& pass, int row, SeenSums& sums);

}  // namespace heightlight
