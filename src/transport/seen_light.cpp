#include "transport/seen_light.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "transport/receiver_blocks.h"

namespace heightlight {

SeenLight::Lattice::Lattice(const Surface& map, const HorizonPlan& plan, const HorizonOptions& options)
    : receivers(map, plan.lattice_stride),
      surface(lattice_surface(map, receivers)),
      mips(build_height_mips(surface)),
      links(surface, mips, plan.lattice_links, all_blocks(surface), options.memory_limit, options.quiet),
      seen(receivers.width, receivers.height) {}

SeenLight::SeenLight(const Surface& surface, const HorizonPlan& plan, const HorizonOptions& options)
    : surface_(surface), seen_(surface.width(), surface.height()) {
  if (plan.lattice_stride > 1) lattice_ = std::make_unique<Lattice>(surface, plan, options);
}

void SeenLight::add_own_links(const HeightMips& mips, const TexelVector& sky, const HorizonPlan& plan,
                              const HorizonOptions& options) {
  std::vector<BlockSet> blocks =
      lattice_ ? blocks_above(surface_, sky, plan.own_links_from) : all_blocks(surface_);
  const std::uint64_t left =
      options.memory_limit - std::min(options.memory_limit, lattice_ ? lattice_->links.bytes() : 0);
  own_ = std::make_unique<HorizonLinks>(surface_, mips, plan.links, std::move(blocks), left, options.quiet);
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
  if (lattice_) {
    lattice_->links.mean_seen(take_lattice(surface_, lattice_->receivers, x), lattice_->seen);
    spread_lattice(surface_, lattice_->receivers, lattice_->seen, seen_);
  }
  if (own_) own_->mean_seen(x, seen_);
  parallel_for(surface_.height(), [&](std::int64_t row) {
    for (std::int64_t i = row * surface_.width(); i < (row + 1) * surface_.width(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      const bool missing = std::isnan(surface_.map.height.values[at]);
      result[i] = missing ? 0 : (1 - sky[i]) * double{seen_.values[at]};
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
