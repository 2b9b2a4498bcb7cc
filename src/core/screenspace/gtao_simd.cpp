// The arithmetic is the same as in gtao_scalar.cpp.

#include "screenspace/gtao_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screenspace/gtao_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "screenspace/slice_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace heightlight::HWY_NAMESPACE {

template <int kTaps>
HWY_INLINE Lanes highest_slopes(const GtaoPass& pass, const std::vector<SliceSample>& side,
                                const Receivers& at) {
  Lanes highest;
  for (VF& slope : highest) slope = hn::Set(kF, -kSteepestSlope);
  for (const SliceSample& sample : side) {
    const Lanes slopes = sample_slopes<kTaps>(pass.depth, at, sample);
    for (std::size_t v = 0; v < kBunch; ++v) highest[v] = hn::Max(highest[v], slopes[v]);
  }
  return highest;
}

// Products are not fused where they decide which branch of eq. 13 a sample takes.
template <int kTaps>
HWY_INLINE Lanes attenuated_slopes(const GtaoPass& pass, const std::vector<SliceSample>& side,
                                   const Receivers& at) {
  const VF one = hn::Set(kF, 1.0F);
  const VF lowest = hn::Set(kF, -1.0F);
  const VF radius = hn::Set(kF, pass.radius);
  const VF per_falloff = hn::Set(kF, pass.per_falloff);
  const VF thickness = hn::Set(kF, pass.thickness);
  Lanes horizon;
  for (VF& cosine : horizon) cosine = lowest;
  for (const SliceSample& sample : side) {
    const Lanes slopes = sample_slopes<kTaps>(pass.depth, at, sample);
    const VF distance = hn::Set(kF, sample.distance);
    for (std::size_t v = 0; v < kBunch; ++v) {
      const VF slope = hn::Max(slopes[v], hn::Set(kF, -kSteepestSlope));
      const VF secant = hn::Sqrt(hn::Add(hn::Mul(slope, slope), one));
      const VF inside = hn::Mul(hn::Sub(radius, hn::Mul(distance, secant)), per_falloff);
      const VF near = hn::Min(hn::Max(inside, hn::Zero(kF)), one);
      const VF cosine = hn::Sub(hn::Mul(near, hn::Add(hn::Div(slope, secant), one)), one);
      const VF sunk = hn::Max(hn::Sub(horizon[v], thickness), lowest);
      horizon[v] = hn::IfThenElse(hn::Ge(cosine, horizon[v]), cosine, sunk);
    }
  }
  for (VF& cosine : horizon) {
    const VF squared = hn::Max(hn::Sub(one, hn::Mul(cosine, cosine)), hn::Set(kF, 1e-12F));
    cosine = hn::Div(cosine, hn::Sqrt(squared));
  }
  return horizon;
}

struct BunchSums {
  Lanes sky, open, solid;
  std::array<Lanes, 3> bent;
};

/// What is summed besides A.
struct WantedSums {
  bool open = false;
  bool solid = false;
  bool bent = false;
};

/// Adds what one side sees; (`x`, `y`) is the side's direction.
HWY_INLINE void add_side(const Lanes& slopes, const Receivers& at, float x, float y, const WantedSums& wanted,
                         BunchSums& sums) {
  const VF one = hn::Set(kF, 1.0F);
  const VF along_x = hn::Set(kF, x);
  const VF along_y = hn::Set(kF, y);
  for (std::size_t v = 0; v < kBunch; ++v) {
    const VF n_z = at.normal_z[v];
    const VF tangent = hn::MulAdd(at.slope_x[v], along_x, hn::Mul(at.slope_y[v], along_y));
    const VF c = hn::Neg(hn::Mul(n_z, tangent));
    const VF m = hn::Max(slopes[v], tangent);
    const Elevation<VF> horizon = elevation(kF, m);
    sums.sky[v] = hn::Add(sums.sky[v], slice_irradiance(c, n_z, horizon));
    if (wanted.solid) sums.solid[v] = hn::Add(sums.solid[v], hn::Sub(one, horizon.sine));
    if (wanted.open) sums.open[v] = hn::Add(sums.open[v], slice_irradiance(c, n_z, tangent));
    if (!wanted.bent) continue;
    const VF q = hn::Div(one, hn::MulAdd(m, m, one));
    const VF cosine = hn::Sqrt(q);
    const VF s = hn::Mul(m, cosine);
    const VF e = hn::Sub(one, s);
    const VF cubed_cosine = hn::Mul(hn::Mul(e, e), hn::Add(s, hn::Set(kF, 2.0F)));
    const VF mixed = hn::Mul(q, cosine);
    const VF squared_sine = hn::Mul(e, hn::MulAdd(s, s, hn::Add(s, one)));
    const VF along = hn::MulAdd(c, cubed_cosine, hn::Mul(n_z, mixed));
    sums.bent[0][v] = hn::MulAdd(along_x, along, sums.bent[0][v]);
    sums.bent[1][v] = hn::MulAdd(along_y, along, sums.bent[1][v]);
    sums.bent[2][v] = hn::Add(sums.bent[2][v], hn::MulAdd(c, mixed, hn::Mul(n_z, squared_sine)));
  }
}

template <int kTaps>
HWY_INLINE void look_around(const GtaoPass& pass, int row, GtaoSums& sums) {
  const WantedSums wanted{
      .open = !sums.open.empty(), .solid = !sums.solid.empty(), .bent = !sums.bent[0].empty()};
  for_receivers(pass.depth, row, [&](const Receivers& at) {
    BunchSums bunch;
    for (Lanes* lanes :
         {&bunch.sky, &bunch.open, &bunch.solid, &bunch.bent[0], &bunch.bent[1], &bunch.bent[2]}) {
      for (VF& lane : *lanes) lane = hn::Zero(kF);
    }
    for (const Slice& slice : pass.tables.table(row, at.column % DepthBuffer::kPhases)) {
      for (std::size_t side = 0; side < 2; ++side) {
        const float sign = side == 0 ? -1.0F : 1.0F;
        const Lanes slopes = pass.attenuated ? attenuated_slopes<kTaps>(pass, slice.sides[side], at)
                                             : highest_slopes<kTaps>(pass, slice.sides[side], at);
        add_side(slopes, at, sign * slice.x, sign * slice.y, wanted, bunch);
      }
    }
    add_to_row(bunch.sky, at.column, sums.sky);
    if (wanted.open) add_to_row(bunch.open, at.column, sums.open);
    if (wanted.solid) add_to_row(bunch.solid, at.column, sums.solid);
    for (std::size_t i = 0; wanted.bent && i < 3; ++i) add_to_row(bunch.bent[i], at.column, sums.bent[i]);
  });
}

void gtao_lanes(const GtaoPass& pass, int row, GtaoSums& sums) {
  with_taps(pass.tables.taps, [&](auto taps) { look_around<taps()>(pass, row, sums); });
}

}  // namespace heightlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace heightlight {

HWY_EXPORT(gtao_lanes);

void gtao_row(const GtaoPass& pass, int row, GtaoSums& sums) {
  HWY_DYNAMIC_DISPATCH(gtao_lanes)(pass, row, sums);
}

}  // namespace heightlight
#endif
