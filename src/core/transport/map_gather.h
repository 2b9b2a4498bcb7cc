#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "transport/gather_walk.h"

namespace heightlight {

/// What one gather over a map walks along: `azimuths` in equal steps, from `turn` of a step on.
struct GatherTurn {
  int azimuths = 4;
  double turn = 0.25;
};

/// Gathers over a whole map. What does not change from one to the next is made once.
class MapGather {
 public:
  /// `sky`: A per texel, which says who has to look closely; both must outlive it. Azimuths of `options` are
  /// not used.
  MapGather(const Surface& surface, const HeightMips& mips, const Map& sky, const WalkOptions& options);

  /// A pyramid that its gathers can read.
  FieldPyramid make_pyramid() const;

  /// Gathers up to kMostFields fields, and calls visit(tile, sums) for every tile of receivers, in any order
  /// and on all threads.
  void run(const GatherTurn& turn, const std::vector<const FieldPyramid*>& fields,
           const std::function<void(const ReceiverTile&, const GatherSums&)>& visit) const;

  /// Likewise, of the tiles or parts of tiles given.
  void run_on(const std::vector<TileFrame>& frames, const GatherTurn& turn,
              const std::vector<const FieldPyramid*>& fields,
              const std::function<void(std::size_t, const ReceiverTile&, const GatherSums&)>& visit) const;

  const Surface& surface() const { return surface_; }

  /// Bytes that one of a map of that size holds, pyramids of fields apart, and those of a pyramid.
  static std::uint64_t bytes(const Surface& surface, const WalkOptions& options);
  static std::uint64_t pyramid_bytes(const Surface& surface, const WalkOptions& options);

 private:
  const Surface& surface_;
  const Map& sky_;
  WalkOptions options_;
  HorizonScene scene_;
};

/// How often the azimuths are halved for receivers that see so much of the surface, as an RMS of 1 − A. What
/// K azimuths leave falls somewhat faster than 1/√K and grows with 1 − A: it is least for what all of them cost
/// together where K goes about as (1 − A)^0.6.
int azimuth_halvings(double surface_share);

}  // namespace heightlight
