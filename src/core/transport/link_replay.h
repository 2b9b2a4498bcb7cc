#pragma once

#include <cstdint>
#include <vector>

#include "transport/light_mips.h"
#include "visibility/link_walk.h"

namespace heightlight {

/// Reads the links of a tile's `blocks` (link_walk.h) against a field: for every receiver of these, the mean
/// of the field over what it sees, weighted by form factors, into `mean`, kSide per row of the tile. A
/// receiver that sees nothing gets the field's value at its own place. The readable one.
void replay_links_scalar(const TileFrame& tile, const std::vector<LinkAzimuth>& azimuths,
                         const BlockSet& blocks, const std::uint8_t* stream, const LightMips& light,
                         float* mean);

/// The fast one: the same means, but for the rounding of fused products where the machine has them.
void replay_links(const TileFrame& tile, const std::vector<LinkAzimuth>& azimuths, const BlockSet& blocks,
                  const std::uint8_t* stream, const LightMips& light, float* mean);

/// First level of light whose blocks are shared by kShared receivers beside each other.
constexpr int kSharedLight = 3;
constexpr int kShared = 8;

}  // namespace heightlight
