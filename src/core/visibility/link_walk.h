#pragma once

#include <bitset>
#include <cstdint>
#include <vector>

#include "visibility/light_nodes.h"
#include "visibility/walk_tile.h"

// Which light reaches a receiver, as a stream of bytes.
//
// Walking outward, the horizon's slope rises from m to m' wherever a new part of the surface comes into
// sight. That part fills the slice between the two, twice whose irradiance is S(m) − S(m') (sky_walk.h). It
// is given to light nodes, in whole steps of 1/kQuantum; what is left of a weight after rounding is carried
// on to the receiver's next one, so that no light is lost and no direction is favoured. A receiver's steps,
// over their sum, are the shares of what it sees in all that it sees; the sky's share comes from a walk of
// its own, with more azimuths.
//
// For each row of a tile and each kBlock receivers of it that are asked for, the stream holds, azimuth by
// azimuth, the number of entries with near nodes, that of the others, and the entries: a node's number and
// kBlock weights.

namespace heightlight {

/// Receivers in a block.
constexpr int kBlock = 16;
constexpr int kEntryBytes = 1 + kBlock;
constexpr int kBlocksAcross = kTileSide / kBlock;

/// Some of a tile's blocks.
using BlockSet = std::bitset<static_cast<std::size_t>(kTileSide) * kBlocksAcross>;

/// Index in a set of the block that the receiver in row i and column j of a tile belongs to.
constexpr std::size_t block_index(int i, int j) {
  return static_cast<std::size_t>(i) * kBlocksAcross + static_cast<std::size_t>(j / kBlock);
}

/// All blocks that have receivers inside the map.
BlockSet all_blocks(const TileFrame& tile);

/// Bytes before the entries of an azimuth: how many there are.
constexpr int kCountBytes = 2;

/// Steps in a weight of 1. The largest, a wall that fills a slice and all of whose light comes from one node,
/// is π.
constexpr float kQuantum = 80;

/// How far along the receiver's own facet that place lies which stands for it: the way to a triangle's middle
/// is two thirds of that from a corner through it to the side across. The rays' rule is the same
/// (ray_traversal.h).
constexpr float kOwnFacet = 2.0F / 3;

/// A rise of the slope by less than this is left for the next sample to see, together with its own.
constexpr float kLeastRise = 0.01F;

/// Nodes of the quadrature of two on [0, 1], Gauss and Legendre's.
constexpr float kNodes[] = {0.21132487F, 0.78867513F};

/// One azimuth's tables.
struct LinkAzimuth {
  AzimuthTable walk;
  LightTable light;
};

std::vector<LinkAzimuth> make_link_azimuths(const Surface& surface, const WalkOptions& options);

/// Appends the links of a tile's `blocks` to `stream`. The readable one.
void walk_links_scalar(const WalkTile& tile, const std::vector<LinkAzimuth>& azimuths, const BlockSet& blocks,
                       std::vector<std::uint8_t>& stream);

/// The fast one. Rounding may move a step from one entry to the next.
void walk_links(const WalkTile& tile, const std::vector<LinkAzimuth>& azimuths, const BlockSet& blocks,
                std::vector<std::uint8_t>& stream);

}  // namespace heightlight
