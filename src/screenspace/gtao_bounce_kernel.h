#pragma once

#include <vector>

#include "heightlight/screenspace.h"
#include "screenspace/slice_samples.h"

// One bounce along GTAO's horizons, for one row of receivers. With S(m) twice a side's irradiance above the
// slope m (gtao_kernel.h), what lies between two successive horizons m < m' of a side has the form factor
// (S(m) − S(m'))/2 over the number of slices: the whole stretch of the surface that rises into view between
// two samples counts as the second one, where the exact walk knows it piece by piece.

namespace heightlight {

/// Sums over the slices, per receiver in a row of the map.
struct SeenSums {
  std::vector<float> hidden;  ///< Σ S(tangent) − S(horizon): twice what is seen of the surface
  std::vector<float> light;   ///< Σ (S(m) − S(m')) × radiance of the sample
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
