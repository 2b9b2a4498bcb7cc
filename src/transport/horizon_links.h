#pragma once

#include <cstdint>
#include <vector>

#include "heightlight/image.h"
#include "transport/light_mips.h"
#include "visibility/link_walk.h"

namespace heightlight {

/// The links of all receivers, found by horizon walks. Tiles whose links fit the memory keep them; the others
/// walk again whenever they are asked.
class HorizonLinks {
 public:
  /// `memory` is the most that links may take, bytes. `surface` and `mips` must outlive it.
  HorizonLinks(const Surface& surface, const HeightMips& mips, const WalkOptions& options,
               std::uint64_t memory, bool quiet);

  /// For every receiver, the mean of `x` over what it sees of the surface, weighted by form factors; its own
  /// x where it sees nothing. Both per texel, `x` finite everywhere; what stands in `mean` at missing samples
  /// means nothing.
  void mean_seen(const TexelVector& x, Image<float>& mean);

  std::uint64_t entries() const;
  std::uint64_t bytes() const;
  /// Share of the tiles that keep their links.
  double kept_share() const;

 private:
  const Surface& surface_;
  const HeightMips& mips_;
  WalkOptions options_;
  std::vector<LinkAzimuth> azimuths_;
  int rings_;
  TileGrid tiles_;
  LightMips light_;
  std::vector<std::vector<std::uint8_t>> streams_;  ///< per tile; empty where it walks again
};

}  // namespace heightlight
