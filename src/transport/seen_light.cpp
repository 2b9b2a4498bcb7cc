#include "transport/seen_light.h"

#include <algorithm>
#include <cmath>

namespace heightlight {

SeenLight::SeenLight(const Surface& surface, const HeightMips& mips, const HorizonPlan& plan,
                     const HorizonOptions& options)
    : surface_(surface), lattice_(surface, plan.link_stride), mean_(lattice_.width, lattice_.height) {
  const bool coarse = plan.link_stride > 1;
  if (coarse) {
    coarse_ = lattice_surface(surface, lattice_);
    coarse_mips_ = build_height_mips(coarse_);
  }
  links_ = std::make_unique<HorizonLinks>(coarse ? coarse_ : surface, coarse ? coarse_mips_ : mips,
                                          plan.links, options.memory_limit, options.quiet);
}

void SeenLight::gather(const TexelVector& x, const TexelVector& sky, TexelVector& result) {
  // Links are read in single precision. Light that it might lose is gathered brighter, by a power of two.
  constexpr int kDimmest = -40;
  int exponent = 0;
  const double brightest = x.cwiseAbs().maxCoeff();
  std::frexp(brightest, &exponent);
  if (brightest > 0 && exponent < kDimmest) {
    exponent = std::max(exponent, -1000);  // of what is dimmer still the power would be infinite
    gather(std::ldexp(1.0, -exponent) * x, sky, result);
    result *= std::ldexp(1.0, exponent);
    return;
  }
  if (lattice_.stride > 1) {
    links_->mean_seen(take_lattice(surface_, lattice_, x), mean_);
  } else {
    links_->mean_seen(x, mean_);
  }
  spread_lattice(surface_, lattice_, mean_, sky, result);
}

}  // namespace heightlight
