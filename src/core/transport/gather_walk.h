#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "visibility/horizon_scene.h"
#include "visibility/walk_tile.h"

// What receivers see of a field on the surface, found while walking.
//
// Walking outward, the horizon's slope rises from m to m' wherever a new part of the surface comes into
// sight. That part fills the slice between the two slopes, and twice its irradiance is S(m) − S(m')
// (sky_walk.h). The sums
//     Σ (S(m) − S(m')) x(place seen)  and  Σ (S(m) − S(m'))
// over a receiver's azimuths have as their ratio the mean of x that the receiver sees. F x is this mean times
// 1 − A. How much of the surface is seen, 1 − A, comes from the walk of the sky, which has more azimuths.

namespace heightlight {

/// The most fields that one walk can gather.
constexpr std::size_t kMostFields = 4;

/// Receivers that walk the same number of azimuths: a block of this many columns and rows.
constexpr int kGatherBlock = 16;
constexpr int kGatherBlockRows = 2;
constexpr int kGatherBlocks = ReceiverTile::kTexels / (kGatherBlock * kGatherBlockRows);

/// Index of the block that the receiver in row i and column j of a tile belongs to.
constexpr std::size_t gather_block(int i, int j) {
  return static_cast<std::size_t>(i / kGatherBlockRows * (ReceiverTile::kSide / kGatherBlock) +
                                  j / kGatherBlock);
}

/// A place that a walk examines, for its height and for the field: between two of the map's samples (near),
/// or a block.
struct GatherSample {
  float way = 0;  ///< horizontal distance from the receiver, texels
  float per_distance = 0;
  float weight[2] = {0, 0};         ///< near: weight of each sample's height, divided by the world distance
  float share = 0;                  ///< near: weight of the second sample in the field
  std::int32_t offset[2] = {0, 0};  ///< near: from the receiver to each sample, in level 0 of a pyramid
  int level = 0;                    ///< level of the block; 0: near
  int row = 0;                      ///< row and column of a place in the block, texels from the receiver
  int column = 0;
};

/// The walk along one azimuth; samples by rising way.
struct GatherAzimuth {
  float world_x = 1;  ///< cos φ
  float world_y = 0;  ///< sin φ, y up the image
  std::vector<GatherSample> samples;
  std::size_t lifted = 0;  ///< index of the first sample that reads lifted heights
  std::size_t near = 0;    ///< index of the first sample that reads a block
};

/// β: a rise above the slope m by less than β (1 + |m|) is not gathered by itself but together with the next
/// one. The finer the samples, the more such rises there are. With this β, gathers on bricks and on fractal
/// ground err as much as with half of it, at reliefs from .1 to 1, and take an eighth less time.
constexpr float least_rise(int samples_per_octave) {
  constexpr float kMost = 0.08F;
  return samples_per_octave > 8 ? 8 * kMost / static_cast<float>(samples_per_octave) : kMost;
}

/// How often a gather's azimuths can be halved, at most, for receivers that need fewer.
constexpr int kMostHalvings = 3;

/// Number of azimuths left after `halvings` halvings, 0 … kMostHalvings. Only even numbers are halved, and
/// none to fewer than `fewest`. The azimuths left are evenly spread, too.
int halved_azimuths(int azimuths, int halvings, int fewest = 1);

/// How a gather walks.
struct GatherWalk {
  std::vector<GatherAzimuth> azimuths =
      {};                ///< in an order such that the first halved_azimuths of them are evenly spread
  float least_rise = 0;  ///< β
};

/// Makes a walk along `options.azimuths` in equal steps, the first at `turn` steps from azimuth 0, through
/// pyramids laid out like `layout`.
GatherWalk make_gather_walk(const Surface& surface, const WalkOptions& options, double turn,
                            const FieldPyramid& layout);

/// Means over the azimuths walked, per receiver of a tile; 0 where none is walked.
struct GatherSums {
  using Values = std::array<float, ReceiverTile::kTexels>;

  alignas(64) Values weight;                             ///< mean of Σ (S(m) − S(m'))
  alignas(64) std::array<Values, kMostFields> weighted;  ///< mean of Σ (S(m) − S(m')) x, per field
};

/// What is gathered, and for which receivers.
struct GatherTask {
  const ReceiverTile& tile;  ///< heights above the map's base
  const HorizonScene& scene;
  const GatherWalk& walk;
  std::array<const FieldPyramid*, kMostFields> fields = {};
  std::size_t field_count = 1;
  std::array<std::uint16_t, kGatherBlocks> azimuths = {};  ///< number walked, per block; 0: none
  float highest = 0;                                       ///< highest of all heights, above the map's base
};

/// Sets the sums of all receivers of the tile.
void walk_gather(const GatherTask& task, GatherSums& sums);

/// As walk_gather, compiled from the same source with one lane per vector.
void walk_gather_by_one(const GatherTask& task, GatherSums& sums);

}  // namespace heightlight
