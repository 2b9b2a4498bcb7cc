// The arithmetic is the same as in hbao_scalar.cpp.

#include "screenspace/hbao_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screenspace/hbao_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "screenspace/slice_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace heightlight::HWY_NAMESPACE {

HWY_INLINE VF sine_of_slope(VF slope) {
  return hn::Div(slope, hn::Sqrt(hn::MulAdd(slope, slope, hn::Set(kF, 1.0F))));
}

/// Without attenuation only the highest horizon matters: sin h − sin t is hidden.
template <int kTaps>
HWY_INLINE void hide_fully(const HbaoPass& pass, const std::vector<SliceSample>& side, const Receivers& at,
                           const Lanes& tangent, Lanes& open) {
  Lanes horizon = tangent;
  for (const SliceSample& sample : side) {
    const Lanes slopes = sample_slopes<kTaps>(pass.depth, at, sample);
    for (std::size_t v = 0; v < kBunch; ++v) horizon[v] = hn::Max(horizon[v], slopes[v]);
  }
  for (std::size_t v = 0; v < kBunch; ++v) {
    const VF hidden = hn::Sub(sine_of_slope(horizon[v]), sine_of_slope(tangent[v]));
    open[v] = hn::Add(open[v], hn::Sub(hn::Set(kF, 1.0F), hidden));
  }
}

template <int kTaps>
HWY_INLINE void hide_attenuated(const HbaoPass& pass, const std::vector<SliceSample>& side,
                                const Receivers& at, const Lanes& tangent, Lanes& open) {
  const VF one = hn::Set(kF, 1.0F);
  Lanes horizon = tangent;
  Lanes sine;
  Lanes hidden;
  for (std::size_t v = 0; v < kBunch; ++v) {
    sine[v] = sine_of_slope(tangent[v]);
    hidden[v] = hn::Zero(kF);
  }
  for (const SliceSample& sample : side) {
    const Lanes slopes = sample_slopes<kTaps>(pass.depth, at, sample);
    const VF squared_way = hn::Set(kF, sample.distance * sample.distance * pass.per_squared_radius);
    for (std::size_t v = 0; v < kBunch; ++v) {
      const auto rises = hn::Gt(slopes[v], horizon[v]);
      if (hn::AllFalse(kF, rises)) continue;
      const VF squared_secant = hn::MulAdd(slopes[v], slopes[v], one);
      const VF raised = hn::Div(slopes[v], hn::Sqrt(squared_secant));
      const VF weight = hn::Max(hn::NegMulAdd(squared_way, squared_secant, one), hn::Zero(kF));
      const VF more = hn::Mul(weight, hn::Sub(raised, sine[v]));
      hidden[v] = hn::Add(hidden[v], hn::IfThenElseZero(rises, more));
      horizon[v] = hn::IfThenElse(rises, slopes[v], horizon[v]);
      sine[v] = hn::IfThenElse(rises, raised, sine[v]);
    }
  }
  for (std::size_t v = 0; v < kBunch; ++v) open[v] = hn::Add(open[v], hn::Sub(one, hidden[v]));
}

template <int kTaps>
HWY_INLINE void look_around(const HbaoPass& pass, int row, std::vector<float>& open) {
  for_receivers(pass.depth, row, [&](const Receivers& at) {
    Lanes sums;
    for (VF& sum : sums) sum = hn::Zero(kF);
    for (const Slice& slice : pass.tables.table(row, at.column % DepthBuffer::kPhases)) {
      for (std::size_t side = 0; side < 2; ++side) {
        const float sign = side == 0 ? -1.0F : 1.0F;
        const VF x = hn::Set(kF, sign * slice.x);
        const VF y = hn::Set(kF, sign * slice.y);
        Lanes tangent;
        for (std::size_t v = 0; v < kBunch; ++v) {
          tangent[v] = hn::MulAdd(at.slope_x[v], x, hn::Mul(at.slope_y[v], y));
        }
        if (pass.per_squared_radius > 0) {
          hide_attenuated<kTaps>(pass, slice.sides[side], at, tangent, sums);
        } else {
          hide_fully<kTaps>(pass, slice.sides[side], at, tangent, sums);
        }
      }
    }
    add_to_row(sums, at.column, open);
  });
}

void hbao_lanes(const HbaoPass& pass, int row, std::vector<float>& open) {
  with_taps(pass.tables.taps, [&](auto taps) { look_around<taps()>(pass, row, open); });
}

}  // namespace heightlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace heightlight {

HWY_EXPORT(hbao_lanes);

void hbao_row(const HbaoPass& pass, int row, std::vector<float>& open) {
  HWY_DYNAMIC_DISPATCH(hbao_lanes)(pass, row, open);
}

}  // namespace heightlight
#endif
