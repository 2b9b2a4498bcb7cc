#pragma once

#include <vector>

#include "heightlight/transport.h"
#include "visibility/link_walk.h"

// Which blocks of receivers need links of their own, where a lattice of receivers tells the others what they
// see. What is seen changes most beside walls, and there receivers see much of the surface: the error of what
// a lattice makes of it grows with 1 − A, which the sky's walk has found. (Brick at 1024², every 8th receiver
// a side: .054 in a gather of the total at ρ = .8. Own links for the blocks with the largest 1 − A, among 1 ×
// 16 receivers, leave .002 of it if they are 54 in a hundred; the best choice would take 46.)

namespace heightlight {

/// The RMS of 1 − `sky` over the block that a texel belongs to, of its receivers that are present. `sky`: the
/// sky's shares, per texel.
double surface_share(const Surface& surface, const TexelVector& sky, int row, int column);

/// A tile's blocks whose surface_share is at least `least`.
BlockSet blocks_above(const Surface& surface, const TexelVector& sky, const TileFrame& tile, double least);

/// Likewise of all tiles of the map, in TileGrid's order.
std::vector<BlockSet> blocks_above(const Surface& surface, const TexelVector& sky, double least);

/// All blocks of all tiles.
std::vector<BlockSet> all_blocks(const Surface& surface);

/// Share of a map's blocks that are in their sets, from 0 to 1.
double block_share(const Surface& surface, const std::vector<BlockSet>& blocks);

}  // namespace heightlight
