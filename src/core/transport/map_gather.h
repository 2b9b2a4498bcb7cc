#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "heightlight/watch.h"
#include "transport/gather_walk.h"

namespace heightlight {

/// What one gather over a map walks along: `azimuths` in equal steps, from `turn` steps on.
struct GatherTurn {
  int azimuths = 4;
  double turn = 0.25;
  const Map* sky = nullptr;  ///< A: receivers that see little of the surface walk fewer (azimuth_halvings),
                             ///< and those that see none do not walk; null: all walk all
  int fewest = 1;            ///< azimuths of those that walk
};

/// Gathers over a whole map. What does not change from one to the next is made once.
class MapGather {
 public:
  /// The surface must outlive it. Azimuths of `options` are not used.
  MapGather(const Surface& surface, const HeightPyramid& pyramid, const WalkOptions& options);

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

/// Bytes that a gather of `fields` fields holds on a map of that size, at 24 samples per octave: few
/// maps want more.
std::uint64_t gather_bytes(int width, int height, std::uint64_t fields);

/// The number of azimuths next to `azimuths` that can be halved as often as pays: up to 4, above that a
/// multiple of 4.
constexpr int even_azimuths(int azimuths) { return azimuths <= 2 ? 2 : (azimuths + 3) / 4 * 4; }

/// The turn of the k-th gather of many, in steps: up to as many as a walk halved kMostHalvings times has
/// between its azimuths. Whatever the first of these are, the turns of receivers that walk every 1st, 2nd,
/// 4th or 8th azimuth lie evenly between two of theirs: of 4000 multipliers this leaves the smallest gaps for
/// 3 to 12 gathers, at most twice the mean one. (The golden ratio is as good for all azimuths. The halved
/// ones it would leave the same sectors again and again, whatever the number of gathers.)
inline double spread_turn(int k) {
  constexpr double kMultiplier = 0.18026;
  return (1 << kMostHalvings) * std::fmod(k * kMultiplier, 1.0);
}

/// How often the azimuths are halved for receivers that see so much of the surface, as an RMS of 1 − A. What
/// K azimuths leave falls somewhat faster than 1/√K and grows with 1 − A: it is least for what all of them
/// cost together where K goes about as (1 − A)^0.6.
int azimuth_halvings(double surface_share);

}  // namespace heightlight
