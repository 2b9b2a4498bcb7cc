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
// sight. That part fills the slice between the two, twice whose irradiance is S(m) − S(m') (sky_walk.h), so
// that
//     Σ (S(m) − S(m')) x(place seen)  and  Σ (S(m) − S(m'))
// over a receiver's azimuths have the mean of x that it sees as their ratio. Its product with 1 − A is F x:
// how much of the surface is seen is the sky's walk's to say, which has more azimuths.

namespace heightlight {

/// Fields that one walk can gather.
constexpr std::size_t kMostFields = 4;

/// Receivers that share how many azimuths they walk: so many columns of so many rows.
constexpr int kGatherBlock = 16;
constexpr int kGatherBlockRows = 2;
constexpr int kGatherBlocks = ReceiverTile::kTexels / (kGatherBlock * kGatherBlockRows);

/// Index of the block that the receiver in row i and column j of a tile belongs to.
constexpr std::size_t gather_block(int i, int j) {
  return static_cast<std::size_t>(i / kGatherBlockRows * (ReceiverTile::kSide / kGatherBlock) +
                                  j / kGatherBlock);
}

/// Where a walk looks, and reads the field: between two of the map's samples, or at a block.
struct GatherSample {
  float way = 0;  ///< texels from the receiver
  float per_distance = 0;
  float weight[2] = {0, 0};         ///< near: of each sample's height, over the world distance
  float share = 0;                  ///< near: of the second sample in the field
  std::int32_t offset[2] = {0, 0};  ///< near: of each sample from the receiver's, in level 0 of a pyramid
  int level = 0;                    ///< of the block; 0: near
  int row = 0;                      ///< of a place in the block, texels from the receiver
  int column = 0;
};

/// One azimuth's walk: by rising way.
struct GatherAzimuth {
  float world_x = 1;  ///< cos φ
  float world_y = 0;  ///< sin φ, y up the image
  std::vector<GatherSample> samples;
  std::size_t lifted = 0;  ///< the first that looks at lifted heights
  std::size_t near = 0;    ///< the first that looks at a block
};

/// β: a rise of a slope m by less than β (1 + |m|) waits for the next sample. Of such rises there are the
/// more the finer the samples are: with this, gathers on bricks and on fractal ground err as much as with
/// half of it, at reliefs from .1 to 1, and take an eighth less time.
constexpr float least_rise(int samples_per_octave) {
  constexpr float kMost = 0.08F;
  return samples_per_octave > 8 ? 8 * kMost / static_cast<float>(samples_per_octave) : kMost;
}

/// How often a gather's azimuths can be halved for receivers that need not look so closely.
constexpr int kMostHalvings = 3;

/// Azimuths that are left after so many halvings, 0 … kMostHalvings, of an even number each, but no fewer
/// than `fewest`: the rest are evenly spread, too.
int halved_azimuths(int azimuths, int halvings, int fewest = 1);

/// How a gather walks.
struct GatherWalk {
  std::vector<GatherAzimuth> azimuths =
      {};                ///< such that the first halved_azimuths of them are evenly spread
  float least_rise = 0;  ///< β
};

/// `azimuths`, in equal steps from `turn` steps on.
GatherWalk make_gather_walk(const Surface& surface, const WalkOptions& options, double turn,
                            const FieldPyramid& layout);

/// Means over the azimuths walked, per receiver of a tile; 0 where none are.
struct GatherSums {
  using Values = std::array<float, ReceiverTile::kTexels>;

  alignas(64) Values weight;                             ///< of Σ (S(m) − S(m'))
  alignas(64) std::array<Values, kMostFields> weighted;  ///< of Σ (S(m) − S(m')) x, per field
};

/// What is gathered, and from where.
struct GatherTask {
  const ReceiverTile& tile;  ///< heights above the map's base
  const HorizonScene& scene;
  const GatherWalk& walk;
  std::array<const FieldPyramid*, kMostFields> fields = {};
  std::size_t field_count = 1;
  std::array<std::uint16_t, kGatherBlocks> azimuths = {};  ///< of each block, the first so many; 0: none
  float highest = 0;                                       ///< of all heights
};

/// Sets the sums of all receivers of the tile.
void walk_gather(const GatherTask& task, GatherSums& sums);

/// The same source with one lane a vector.
void walk_gather_by_one(const GatherTask& task, GatherSums& sums);

}  // namespace heightlight
