#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "heightlight/watch.h"
#include "transport/gather_walk.h"

namespace heightlight {

/// What one gather over a map walks along: `azimuths` in equal steps, the first at `turn` steps from azimuth
/// 0.
struct GatherTurn {
  int azimuths = 4;
  double turn = 0.25;
  const Map* sky = nullptr;  ///< A: receivers that see little of the surface walk fewer azimuths
                             ///< (azimuth_halvings), and those that see none do not walk; null: all
                             ///< receivers walk all azimuths
  int fewest = 1;            ///< azimuths of a receiver that walks
};

/// Gathers over a whole map. What does not change from one gather to the next is made once.
class MapGather {
 public:
  /// The surface must outlive this object. `options.azimuths` is ignored.
  MapGather(const Surface& surface, const HeightPyramid& pyramid, const WalkOptions& options);

  /// Returns an unfilled pyramid with the layout that these gathers read.
  FieldPyramid make_pyramid() const;

  /// Gathers 1 to kMostFields fields, and calls visit(tile, sums) for every tile of receivers, in any order
  /// and on all threads. The watch is asked whether to go on.
  void run(const GatherTurn& turn, const std::vector<const FieldPyramid*>& fields,
           const std::function<void(const ReceiverTile&, const GatherSums&)>& visit,
           const Watch& watch = {}) const;

  /// As run, but only for the given tiles or parts of tiles; visit also receives the index of the frame.
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

/// Bytes that a gather of `fields` fields holds on a map of that size, at 24 samples per octave; few maps
/// need more.
std::uint64_t gather_bytes(int width, int height, std::uint64_t fields);

/// `azimuths` rounded up to a number that can be halved as often as is worthwhile: 2, or a multiple of 4.
constexpr int even_azimuths(int azimuths) { return azimuths <= 2 ? 2 : (azimuths + 3) / 4 * 4; }

/// The turn of the k-th gather of many, in steps between azimuths: from 0 to the number of steps between the
/// azimuths of a walk halved kMostHalvings times. However many gathers are made, for receivers that walk
/// every 1st, 2nd, 4th or 8th azimuth the turns lie evenly between two of these azimuths: of 4000 multipliers
/// tried, this one leaves the smallest gaps for 3 to 12 gathers, at most twice the mean gap. (The golden
/// ratio is as good for receivers that walk all azimuths. With halved azimuths it would leave out the same
/// sectors again and again, whatever the number of gathers.)
inline double spread_turn(int k) {
  constexpr double kMultiplier = 0.18026;
  return (1 << kMostHalvings) * std::fmod(k * kMultiplier, 1.0);
}

/// How often the azimuths are halved, 0 … kMostHalvings, for receivers that see this share of the surface, an
/// RMS of 1 − A. The error of K azimuths falls somewhat faster than 1/√K and grows with 1 − A: for a given
/// cost of all receivers together it is least where K is about proportional to (1 − A)^0.6.
int azimuth_halvings(double surface_share);

}  // namespace heightlight
