// Elevations for vector kernels: included once per target, by the files that Highway compiles for each.

#if defined(HEIGHTLIGHT_ELEVATION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HEIGHTLIGHT_ELEVATION_INL_H
#undef HEIGHTLIGHT_ELEVATION_INL_H
#else
#define HEIGHTLIGHT_ELEVATION_INL_H
#endif

#include <hwy/highway.h>

#include <array>
#include <numbers>

HWY_BEFORE_NAMESPACE();
namespace heightlight::HWY_NAMESPACE {

/// A direction at elevation h: cos h ≥ 0, sin h, and its angle from the zenith, π/2 − h.
template <class V>
struct Elevation {
  V cosine, sine, from_zenith;
};

/// asin x for 0 ≤ x ≤ 1/√2, to 1e-8: x + x³ P(x²), where P was found by Remez' exchange.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V arc_sine(D d, V x) {
  namespace hn = hwy::HWY_NAMESPACE;
  constexpr std::array<float, 7> kTerms{0.1666723450F, 0.0747834887F,  0.0476243157F, 0.0104305845F,
                                        0.0934011999F, -0.1153045737F, 0.1237215986F};
  const V square = hn::Mul(x, x);
  V sum = hn::Set(d, kTerms[6]);
  for (std::size_t i = 6; i-- > 0;) sum = hn::MulAdd(sum, square, hn::Set(d, kTerms[i]));
  return hn::MulAdd(hn::Mul(x, square), sum, x);
}

/// 1/√x for normal x, to 2e-7 of its value, and exactly 1 for x = 1. Newton's steps improve the machine's
/// estimate, which is good to 11 bits on x86 and to few elsewhere. Divisions and roots would be most of a
/// slice's cost.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V reciprocal_root(D d, V x) {
  namespace hn = hwy::HWY_NAMESPACE;
  constexpr bool kIsX86 = HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128;
  constexpr int kSteps = kIsX86 ? 2 : 4;
  V root = hn::ApproximateReciprocalSqrt(x);
  for (int i = 0; i < kSteps; ++i) {
    const V missing = hn::NegMulAdd(hn::Mul(x, root), root, hn::Set(d, 1.0F));
    root = hn::MulAdd(hn::Mul(hn::Set(d, 0.5F), root), missing, root);
  }
  return root;
}

/// Elevation of the direction that rises by `slope` for each unit along the ground. A slope steeper than 1e18
/// counts as 1e18. Sine and cosine are accurate to 2e-7, angles to 3e-7; level ground is exact.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE Elevation<V> elevation(D d, V slope) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V one = hn::Set(d, 1.0F);
  const V half_pi = hn::Set(d, std::numbers::pi_v<float> / 2);
  const V size = hn::Min(hn::Abs(slope), hn::Set(d, 1e18F));
  const V cosine = reciprocal_root(d, hn::MulAdd(size, size, one));
  const V sine = hn::Min(hn::Mul(size, cosine), one);
  const V angle = arc_sine(d, hn::Min(sine, cosine));  // |h| or π/2 − |h|, whichever is smaller
  const auto steep = hn::Gt(sine, cosine);
  const V from_zenith = hn::IfThenElse(steep, angle, hn::Sub(half_pi, angle));
  const auto falls = hn::Lt(slope, hn::Zero(d));
  return {cosine, hn::CopySign(sine, slope),
          hn::IfThenElse(falls, hn::Sub(hn::Set(d, std::numbers::pi_v<float>), from_zenith), from_zenith)};
}

}  // namespace heightlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
