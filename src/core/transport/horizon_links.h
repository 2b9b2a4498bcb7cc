#pragma once

#include <cstdint>
#include <vector>

#include "heightlight/image.h"
#include "heightlight/transport.h"
#include "transport/light_mips.h"
#include "visibility/link_walk.h"

namespace heightlight {

/// Links of a map's receivers, found by horizon walks. Tiles whose links fit the memory keep them; the others
/// walk again whenever they are asked.
class HorizonLinks {
 public:
  /// `blocks`, tile by tile, are those whose receivers have links. `surface` and `mips` must outlive it.
  HorizonLinks(const Surface& surface, const HeightMips& mips, const WalkOptions& options,
               std::vector<BlockSet> blocks, const LinkLimits& limits);

  /// For every receiver with links, the mean of `x` over what it sees of the surface, weighted by form
  /// factors; its own x where it sees nothing. Both per texel, `x` finite everywhere; `mean` stays as it is
  /// elsewhere, but for missing samples beside such receivers, where it means nothing.
  void mean_seen(const TexelVector& x, Image<float>& mean);

  std::uint64_t entries() const;
  std::uint64_t bytes() const;
  /// Share of the tiles with links that keep them.
  double kept_share() const;

 private:
  const Surface& surface_;
  const HeightMips& mips_;
  WalkOptions options_;
  std::vector<LinkAzimuth> azimuths_;
  int rings_;
  TileGrid tiles_;
  std::vector<BlockSet> blocks_;  ///< per tile
  LightMips light_;
  Watch gather_watch_;                              ///< is told nothing, and asked whether to go on
  std::vector<std::vector<std::uint8_t>> streams_;  ///< per tile; empty where it has none, or walks again
};

}  // namespace heightlight
