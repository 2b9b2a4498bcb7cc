#pragma once

#include <memory>

#include "transport/horizon_links.h"
#include "transport/receiver_lattice.h"

namespace heightlight {

/// What receivers see of the surface: links of a lattice of them, spread to all.
class SeenLight {
 public:
  SeenLight(const Surface& surface, const HeightMips& mips, const HorizonPlan& plan,
            const HorizonOptions& options);
  SeenLight(const SeenLight&) = delete;  // its links refer to its surface
  SeenLight& operator=(const SeenLight&) = delete;

  /// F x, given the sky's shares.
  void gather(const TexelVector& x, const TexelVector& sky, TexelVector& result);

  const HorizonLinks& links() const { return *links_; }

 private:
  const Surface& surface_;
  ReceiverLattice lattice_;
  Surface coarse_;  ///< of the lattice, unless it is the map itself
  HeightMips coarse_mips_;
  std::unique_ptr<HorizonLinks> links_;
  Image<float> mean_;  ///< what the lattice's receivers see
};

}  // namespace heightlight
