#pragma once

#include <memory>

#include "transport/horizon_links.h"
#include "transport/receiver_lattice.h"

namespace heightlight {

/// What receivers see of the surface: by links of their own, or spread from those of a lattice of receivers.
class SeenLight {
 public:
  /// The lattice's links, where the plan has a lattice. `surface` must outlive it.
  SeenLight(const Surface& surface, const LinkPlan& plan, const LinkLimits& limits);
  SeenLight(const SeenLight&) = delete;  // its links refer to its surface
  SeenLight& operator=(const SeenLight&) = delete;

  /// Gives links of their own to the receivers to which the plan does; `sky`: their sky's shares. `mips` must
  /// outlive it.
  void add_own_links(const HeightMips& mips, const TexelVector& sky, const LinkPlan& plan,
                     const LinkLimits& limits);

  /// F x, given the sky's shares.
  void gather(const TexelVector& x, const TexelVector& sky, TexelVector& result);

  std::uint64_t link_count() const;
  std::uint64_t bytes() const;
  /// Share of the tiles that keep their links, of the receivers with their own where there are any.
  double kept_share() const;

 private:
  struct Lattice {
    Lattice(const Surface& map, const LinkPlan& plan, const LinkLimits& limits);

    ReceiverLattice receivers;
    Surface surface;  ///< of their samples
    HeightMips mips;
    HorizonLinks links;
    Image<float> seen;
  };

  const Surface& surface_;
  std::unique_ptr<Lattice> lattice_;
  std::unique_ptr<HorizonLinks> own_;
  Image<float> seen_;
};

}  // namespace heightlight
