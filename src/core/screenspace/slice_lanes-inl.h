// How vector kernels look along slices. Included once per target, by the files that Highway compiles for
// each. The lanes hold receivers of one row, four columns apart, which share their noise; the texels that
// they read lie side by side in the depth buffer's phases.

#if defined(HEIGHTLIGHT_SLICE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HEIGHTLIGHT_SLICE_LANES_INL_H
#undef HEIGHTLIGHT_SLICE_LANES_INL_H
#else
#define HEIGHTLIGHT_SLICE_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <array>
#include <type_traits>

#include "base/elevation-inl.h"
#include "screenspace/slice_samples.h"

HWY_BEFORE_NAMESPACE();
namespace heightlight::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, 8>;
using VF = hn::Vec<F>;
constexpr F kF;

/// Vectors walked together, so that the places of a sample are found once for all of them.
constexpr std::size_t kBunch = 4;
static_assert(kBunch * hn::MaxLanes(kF) <= kMostReceivers);

using Lanes = std::array<VF, kBunch>;

/// Receivers of one phase of a row, from `column` on.
struct Receivers {
  int row = 0;
  int column = 0;
  Lanes height, slope_x, slope_y, normal_z;
};

HWY_INLINE Receivers load_receivers(const DepthBuffer& depth, int row, int column) {
  Receivers at;
  at.row = row;
  at.column = column;
  const std::size_t first = depth.index(row, column);
  for (std::size_t v = 0; v < kBunch; ++v) {
    const std::size_t i = first + v * hn::Lanes(kF);
    at.height[v] = hn::LoadU(kF, depth.heights.data() + i);
    at.slope_x[v] = hn::LoadU(kF, depth.slope_x.data() + i);
    at.slope_y[v] = hn::LoadU(kF, depth.slope_y.data() + i);
    at.normal_z[v] = hn::LoadU(kF, depth.normal_z.data() + i);
  }
  return at;
}

/// Index in the depth buffer's heights of the texel that the first receiver reads at the tap.
HWY_INLINE std::size_t tap_index(const DepthBuffer& depth, const Receivers& at, const DepthTap& tap) {
  int row = at.row + tap.row;
  if (row >= depth.period_rows) row -= depth.period_rows;
  int column = at.column + tap.column;
  if (column >= depth.period_columns) column -= depth.period_columns;
  return depth.index(row, column);
}

/// Slopes under which the receivers see a sample of kTaps texels.
template <int kTaps>
HWY_INLINE Lanes sample_slopes(const DepthBuffer& depth, const Receivers& at, const SliceSample& sample) {
  Lanes slopes;
  const float* heights = depth.heights.data() + tap_index(depth, at, sample.taps[0]);
  const VF weight = hn::Set(kF, sample.taps[0].weight);
  for (std::size_t v = 0; v < kBunch; ++v) {
    slopes[v] = hn::Mul(weight, hn::Sub(hn::LoadU(kF, heights + v * hn::Lanes(kF)), at.height[v]));
  }
  for (std::size_t i = 1; i < kTaps; ++i) {
    const float* others = depth.heights.data() + tap_index(depth, at, sample.taps[i]);
    const VF share = hn::Set(kF, sample.taps[i].weight);
    for (std::size_t v = 0; v < kBunch; ++v) {
      const VF above = hn::Sub(hn::LoadU(kF, others + v * hn::Lanes(kF)), at.height[v]);
      slopes[v] = hn::MulAdd(share, above, slopes[v]);
    }
  }
  return slopes;
}

/// Twice a side's irradiance above a horizon (gtao_kernel.h).
HWY_INLINE VF slice_irradiance(VF c, VF n_z, const Elevation<VF>& horizon) {
  const VF q = hn::Mul(horizon.cosine, horizon.cosine);
  const VF zenith = hn::NegMulAdd(horizon.sine, horizon.cosine, horizon.from_zenith);
  return hn::MulAdd(c, zenith, hn::Mul(n_z, q));
}

/// As above, for the slope m of the horizon.
HWY_INLINE VF slice_irradiance(VF c, VF n_z, VF m) { return slice_irradiance(c, n_z, elevation(kF, m)); }

/// Adds the lanes to values that are four columns apart in a row of the map, up to the end of the row.
HWY_INLINE void add_to_row(const Lanes& lanes, int column, std::vector<float>& row) {
  alignas(64) std::array<float, kBunch * hn::MaxLanes(kF)> values;
  for (std::size_t v = 0; v < kBunch; ++v) hn::Store(lanes[v], kF, values.data() + v * hn::Lanes(kF));
  auto at = static_cast<std::size_t>(column);
  for (std::size_t i = 0; i < kBunch * hn::Lanes(kF) && at < row.size(); ++i, at += DepthBuffer::kPhases) {
    row[at] += values[i];
  }
}

/// Calls body(receivers) for bunches that together cover the row.
template <class Body>
HWY_INLINE void for_receivers(const DepthBuffer& depth, int row, const Body& body) {
  const int step = DepthBuffer::kPhases * static_cast<int>(kBunch * hn::Lanes(kF));
  for (int phase = 0; phase < DepthBuffer::kPhases; ++phase) {
    for (int column = phase; column < depth.width; column += step) body(load_receivers(depth, row, column));
  }
}

/// Calls look(n) with the number of texels that a sample reads as a compile-time constant: 1, or the 3 of a
/// triangle.
template <class Look>
HWY_INLINE void with_taps(int taps, Look&& look) {
  if (taps == 1) {
    look(std::integral_constant<int, 1>());
  } else {
    look(std::integral_constant<int, 3>());
  }
}

}  // namespace heightlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
