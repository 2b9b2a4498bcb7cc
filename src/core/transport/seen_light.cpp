#include "transport/seen_light.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/texel_algebra.h"
#include "transport/receiver_blocks.h"

namespace heightlight {

SeenLight::Lattice::Lattice(const Surface& map, const LinkPlan& plan, const LinkLimits& limits)
    : receivers(map, plan.lattice_stride),
      surface(lattice_surface(map, receivers)),
      mips(build_height_mips(surface)),
      links(surface, mips, plan.lattice_walk, all_blocks(surface), limits),
      seen(receivers.width, receivers.height) {}

SeenLight::SeenLight(const Surface& surface, const LinkPlan& plan, const LinkLimits& limits)
    : surface_(surface), seen_(surface.width(), surface.height()) {
  if (plan.lattice_stride > 1) lattice_ = std::make_unique<Lattice>(surface, plan, limits);
}

void SeenLight::add_own_links(const HeightMips& mips, const TexelVector& sky, const LinkPlan& plan,
                              const LinkLimits& limits) {
  std::vector<BlockSet> blocks = lattice_ ? blocks_above(surface_, sky, plan.own_from) : all_blocks(surface_);
  LinkLimits left = limits;
  left.memory -= std::min(limits.memory, lattice_ ? lattice_->links.bytes() : 0);
  own_ = std::make_unique<HorizonLinks>(surface_, mips, plan.walk, std::move(blocks), left);
}

void SeenLight::gather(const TexelVector& x, const TexelVector& sky, TexelVector& result) {
  // Links are read in single precision. Light that it might lose is gathered brighter, by a power of two.
  constexpr int kDimmest = -40;
  int exponent = 0;
  const double brightest = as_eigen(x).cwiseAbs().maxCoeff();
  std::frexp(brightest, &exponent);
  if (brightest > 0 && exponent < kDimmest) {
    exponent = std::max(exponent, -1000);  // of what is dimmer still the power would be infinite
    gather(to_texels(std::ldexp(1.0, -exponent) * as_eigen(x)), sky, result);
    as_eigen(result) *= std::ldexp(1.0, exponent);
    return;
  }
  if (lattice_) {
    lattice_->links.mean_seen(take_lattice(surface_, lattice_->receivers, x), lattice_->seen);
    spread_lattice(surface_, lattice_->receivers, lattice_->seen, seen_);
  }
  if (own_) own_->mean_seen(x, seen_);
  parallel_for(surface_.height(), [&](std::int64_t row) {
    const std::size_t begin = seen_.index(static_cast<int>(row), 0);
    for (std::size_t i = begin; i < begin + static_cast<std::size_t>(seen_.width); ++i) {
      const bool missing = std::isnan(surface_.map.height.values[i]);
      result[i] = missing ? 0 : (1 - sky[i]) * double{seen_.values[i]};
    }
  });
}

std::uint64_t SeenLight::link_count() const {
  return kBlock * ((lattice_ ? lattice_->links.entries() : 0) + (own_ ? own_->entries() : 0));
}

std::uint64_t SeenLight::bytes() const {
  return (lattice_ ? lattice_->links.bytes() : 0) + (own_ ? own_->bytes() : 0);
}

double SeenLight::kept_share() const {
  return own_ ? own_->kept_share() : lattice_ ? lattice_->links.kept_share() : 1;
}

}  // namespace heightlight
