#pragma once

#include <cstdint>
#include <vector>

#include "visibility/walk_table.h"

// Where light is read along one azimuth: as densely as the walk looks at heights, but as means of ever larger
// blocks. With ν the walk's fineness:
//
//   * node 0: the receiver itself;
//   * level 0, up to 2ν texels of way: the walk's own samples, interpolated between the two of the map beside
//   them;
//   * level λ ≥ 1, ways ν·2^λ to 2ν·2^λ: ν nodes, 2^λ apart, each a block of 2^λ × 2^λ samples.
//
// Like a walk's samples, nodes are the same seen from every vertex: a link is a node's number and a weight,
// and neighbouring receivers read neighbouring values.

namespace heightlight {

struct LightNode {
  int level = 0;
  int row[2] = {0, 0};  ///< texels from the receiver; the second is for level 0 only
  int column[2] = {0, 0};
  float share = 0;  ///< of the second sample
};

/// To which node what a walk's sample reveals is given: the visible part of the profile between the sample
/// before and this one. Near the receiver both samples are nodes, `node` and `node + 1`, and split it by the
/// place seen.
struct NodeShare {
  std::uint8_t node = 0;
  bool splits = false;
};

/// Nodes of an azimuth, so that a byte names one. What lies beyond the last goes to that.
constexpr std::size_t kMostNodes = 256;

/// What links of one azimuth look at.
struct LightTable {
  std::vector<LightNode> nodes;               ///< at most kMostNodes; by rising way, level 0 first
  int near_nodes = 0;                         ///< of level 0
  std::vector<NodeShare> near;                ///< per near sample of the walk
  std::vector<std::vector<NodeShare>> rings;  ///< per sample of each ring
};

/// For the walk's table of azimuth k.
LightTable make_light_table(const Surface& surface, const WalkOptions& options, int k,
                            const AzimuthTable& walk);

}  // namespace heightlight
