#pragma once

#include <vector>

namespace heightlight {

/// Blocks along an axis of the next level, of `count` of this one: two each, and the last may be half
/// outside.
constexpr int half_blocks(int count) { return (count + 1) / 2; }

/// For the blocks `first` … `first + count − 1` along an axis of `samples` samples, at a level whose blocks
/// are 2^level samples wide: the block of the map that stands for each, or −1 where nothing is. Blocks beyond
/// the edge of a tiling map are found by their middle sample, since a side need not be a multiple of a
/// block's; one that straddles the edge counts as inside.
std::vector<int> block_sources(int first, int count, int level, int samples, bool tiles);

}  // namespace heightlight
