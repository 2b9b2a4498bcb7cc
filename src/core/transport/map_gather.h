#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "heightlight/watch.h"
#include "transport/gather_walk.h"

namespace heightlight {

/// What one gather over a map walks along: `azimuths` in equal steps, from `turn` of a step on.
struct GatherTurn {
  int azimuths = 4;
  double turn = 0.25;
  const Map* sky = nullptr;  ///< A: receivers that see little of the surface walk fewer (azimuth_halvings),
                             ///< and those that see none do not walk; null: all walk all
};

/// Gathers over a whole map. What does not change from one to the next is made once.
class MapGather {
 public:
  /// The surface must outlive it. Azimuths of `options` are not used.
  MapGather(const Surface& surface, const HeightMips& mips, const WalkOptions& options);

  /// A pyramid that its gathers can read.
  FieldPyramid make_pyramid() const;

  /// Gathers up to kMostFields fields, and calls visit(tile, sums) for every tile of receivers, in any order
  /// and on all threads. The watch is asked whether to go on.
  void run(const GatherTurn& turn, const std::vector<const FieldPyramid*>& fields,
           const std::function<void(const ReceiverTile&, const GatherSums&)>& visit,
           const Watch& watch = {}) const;

  /// Likewise, of the tiles or parts of tiles given.
  void run_on(const std::vector<TileFrame>& frames, const GatherTurn& turn,
              const std::vector<const FieldPyramid*>& fields,
              const std::function<void(std::size_t, const ReceiverTile&, const GatherSums&)>& visit,
              const Watch& watch = {}) const;

  const Surface& surface() const { return surface_; }

 private:
  const Surface& surface_;
  WalkOptions options_;
  HorizonScene scene_;
};

/// Bytes that a gather of `fields` fields holds on a map of that size, at a fineness of 24: few maps want
/// more.
std::uint64_t gather_bytes(int width, int height, std::uint64_t fields);

/// The number of azimuths next to `azimuths` that can be halved as often as pays: up to 4, above that a
/// multiple of 4.
constexpr int even_azimuths(int azimuths) { return azimuths <= 2 ? 2 : (azimuths + 3) / 4 * 4; }

/// The turn of the k-th gather of many: as far from all before it as can be, by the golden ratio.
inline double golden_turn(int k) { return std::fmod(k * 0.6180339887498949, 1.0); }

/// How often the azimuths are halved for receivers that see so much of the surface, as an RMS of 1 − A. What
/// K azimuths leave falls somewhat faster than 1/√K and grows with 1 − A: it is least for what all of them
/// cost together where K goes about as (1 − A)^0.6.
int azimuth_halvings(double surface_share);

}  // namespace heightlight
