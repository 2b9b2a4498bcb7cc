#pragma once

#include <vector>

#include "heightlight/screenspace.h"
#include "screenspace/slice_samples.h"

// One bounce along GTAO's horizons, for one row of receivers. With S(m) twice a side's irradiance above the
// slope m (gtao_kernel.h), what lies between two successive horizons m < m' of a side has the form factor
// (S(m) − S(m'))/2 over the number of slices: what rises into view between a sample and the one before it
// sends the mean of what the two send. (As much as the second alone: between bricks, where that is a lit top
// and what is seen is the wall below it, totals at albedo 0.8 come out too bright by 0.05.)

namespace heightlight {

/// Sums over the slices, per receiver in a row of the map.
struct SeenSums {
  std::vector<float> hidden;  ///< Σ S(tangent) − S(horizon): twice what is seen of the surface
  std::vector<float> light;   ///< Σ (S(m) − S(m')) × mean radiance
};

struct BounceSlicePass {
  const DepthBuffer& depth;
  const SliceTables& tables;
  const std::vector<float>& radiance;  ///< like DepthBuffer::heights; finite everywhere
};

/// Adds to the sums of the row's receivers. The readable one.
void gather_slices_scalar(const BounceSlicePass& pass, int row, SeenSums& sums);

/// The fast one: receivers four apart side by side. The same, but for the rounding of fused products and of
/// the arc tangent (2e-8).
void gather_slices(const BounceSlicePass& pass, int row, SeenSums& sums);

}  // namespace heightlight
