// An arc tangent for vector kernels: included once per target, by the files that Highway compiles for each.

#if defined(HEIGHTLIGHT_ARC_TANGENT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HEIGHTLIGHT_ARC_TANGENT_INL_H
#undef HEIGHTLIGHT_ARC_TANGENT_INL_H
#else
#define HEIGHTLIGHT_ARC_TANGENT_INL_H
#endif

#include <hwy/highway.h>

#include <array>
#include <numbers>

HWY_BEFORE_NAMESPACE();
namespace heightlight::HWY_NAMESPACE {

/// atan x for |x| ≤ 1, to 2e-8 (Abramowitz and Stegun 4.4.49).
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V atan_unit(D d, V x) {
  namespace hn = hwy::HWY_NAMESPACE;
  constexpr std::array<float, 9> kTerms{1.0F,           -0.3333314528F, 0.1999355085F,
                                        -0.1420889944F, 0.1065626393F,  -0.0752896400F,
                                        0.0429096138F,  -0.0161657367F, 0.0028662257F};
  const V square = hn::Mul(x, x);
  V sum = hn::Set(d, kTerms[8]);
  for (std::size_t i = 8; i-- > 0;) sum = hn::MulAdd(sum, square, hn::Set(d, kTerms[i]));
  return hn::Mul(sum, x);
}

/// atan x for any x.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V arc_tangent(D d, V x) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V one = hn::Set(d, 1.0F);
  const V half_pi = hn::Set(d, std::numbers::pi_v<float> / 2);
  const V size = hn::Abs(x);
  const V angle = atan_unit(d, hn::Div(hn::Min(size, one), hn::Max(size, one)));
  return hn::CopySign(hn::IfThenElse(hn::Gt(size, one), hn::Sub(half_pi, angle), angle), x);
}

}  // namespace heightlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
