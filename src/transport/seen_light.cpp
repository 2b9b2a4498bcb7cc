#include "transport/seen_light.h"

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
  if (lattice_.stride > 1) {
    links_->mean_seen(take_lattice(surface_, lattice_, x), mean_);
  } else {
    links_->mean_seen(x, mean_);
  }
  spread_lattice(surface_, lattice_, mean_, sky, result);
}

}  // namespace heightlight
