// The arithmetic is the same as in gtao_bounce_scalar.cpp.

#include <utility>

#include "screenspace/gtao_bounce_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screenspace/gtao_bounce_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "screenspace/slice_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace heightlight::HWY_NAMESPACE {

/// Radiance of a sample as each receiver sees it; the receiver's own radiance where there is no sample.
template <int kTaps>
HWY_INLINE Lanes sample_radiance(const BounceSlicePass& pass, const Receivers& at,
                                 const SliceSample* sample) {
  Lanes radiance;
  if (!sample) {
    const float* here = pass.radiance.data() + pass.depth.index(at.row, at.column);
    for (std::size_t v = 0; v < kBunch; ++v) radiance[v] = hn::LoadU(kF, here + v * hn::Lanes(kF));
    return radiance;
  }
  for (VF& lane : radiance) lane = hn::Zero(kF);
  for (std::size_t i = 0; i < kTaps; ++i) {
    const float* there = pass.radiance.data() + tap_index(pass.depth, at, sample->taps[i]);
    const VF share = hn::Set(kF, sample->taps[i].weight * sample->distance);
    for (std::size_t v = 0; v < kBunch; ++v) {
      radiance[v] = hn::MulAdd(share, hn::LoadU(kF, there + v * hn::Lanes(kF)), radiance[v]);
    }
  }
  return radiance;
}

template <int kTaps>
HWY_INLINE void gather_side(const BounceSlicePass& pass, const std::vector<SliceSample>& side,
                            const Receivers& at, const Lanes& tangent, Lanes& hidden, Lanes& light) {
  Lanes c;
  Lanes open;
  for (std::size_t v = 0; v < kBunch; ++v) {
    c[v] = hn::Neg(hn::Mul(at.normal_z[v], tangent[v]));
    open[v] = slice_irradiance(c[v], at.normal_z[v], tangent[v]);
  }
  Lanes horizon = tangent;
  Lanes above = open;
  const SliceSample* before = nullptr;
  for (const SliceSample& sample : side) {
    const SliceSample* last = std::exchange(before, &sample);
    const Lanes slopes = sample_slopes<kTaps>(pass.depth, at, sample);
    bool any = false;
    for (std::size_t v = 0; v < kBunch; ++v) any |= !hn::AllFalse(kF, hn::Gt(slopes[v], horizon[v]));
    if (!any) continue;
    const Lanes near = sample_radiance<kTaps>(pass, at, last);
    const Lanes far = sample_radiance<kTaps>(pass, at, &sample);
    for (std::size_t v = 0; v < kBunch; ++v) {
      const auto rises = hn::Gt(slopes[v], horizon[v]);
      if (hn::AllFalse(kF, rises)) continue;
      const VF rest = slice_irradiance(c[v], at.normal_z[v], slopes[v]);
      const VF mean = hn::Mul(hn::Set(kF, 0.5F), hn::Add(near[v], far[v]));
      const VF more = hn::Mul(hn::Sub(above[v], rest), mean);
      light[v] = hn::Add(light[v], hn::IfThenElseZero(rises, more));
      above[v] = hn::IfThenElse(rises, rest, above[v]);
      horizon[v] = hn::IfThenElse(rises, slopes[v], horizon[v]);
    }
  }
  for (std::size_t v = 0; v < kBunch; ++v) hidden[v] = hn::Add(hidden[v], hn::Sub(open[v], above[v]));
}

template <int kTaps>
HWY_INLINE void look_around(const BounceSlicePass& pass, int row, SeenSums& sums) {
  for_receivers(pass.depth, row, [&](const Receivers& at) {
    Lanes hidden;
    Lanes light;
    for (std::size_t v = 0; v < kBunch; ++v) hidden[v] = light[v] = hn::Zero(kF);
    for (const Slice& slice : pass.tables.table(row, at.column % DepthBuffer::kPhases)) {
      for (std::size_t side = 0; side < 2; ++side) {
        const float sign = side == 0 ? -1.0F : 1.0F;
        const VF x = hn::Set(kF, sign * slice.x);
        const VF y = hn::Set(kF, sign * slice.y);
        Lanes tangent;
        for (std::size_t v = 0; v < kBunch; ++v) {
          tangent[v] = hn::MulAdd(at.slope_x[v], x, hn::Mul(at.slope_y[v], y));
        }
        gather_side<kTaps>(pass, slice.sides[side], at, tangent, hidden, light);
      }
    }
    add_to_row(hidden, at.column, sums.hidden);
    add_to_row(light, at.column, sums.light);
  });
}

void gather_slices_lanes(const BounceSlicePass& pass, int row, SeenSums& sums) {
  with_taps(pass.tables.taps, [&](auto taps) { look_around<taps()>(pass, row, sums); });
}

}  // namespace heightlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace heightlight {

HWY_EXPORT(gather_slices_lanes);

void gather_slices(const BounceSlicePass& pass, int row, SeenSums& sums) {
  HWY_DYNAMIC_DISPATCH(gather_slices_lanes)(pass, row, sums);
}

}  // namespace heightlight
#endif
