#pragma once

#include <cstdint>
#include <vector>

#include "transport/light_mips.h"
#include "visibility/link_walk.h"

namespace heightlight {

/// Reads a tile's links (link_walk.h) against a field: for every receiver, the mean of the field over what it
/// sees, weighted by form factors, into `mean`, kSide per row of the tile. A receiver without links gets the
/// field's value at its own place. Returns the number of steps of weight that were read. The readable one.
void replay_links_scalar(const TileFrame& tile, const std::vector<LinkAzimuth>& azimuths,
                         const std::uint8_t* stream, const LightMips& light, float* mean);

/// The fast one: the same means, but for the rounding of fused products where the machine has them.
void replay_links(const TileFrame& tile, const std::vector<LinkAzimuth>& azimuths, const std::uint8_t* stream,
                  const LightMips& light, float* mean);

/// First level of light whose blocks are shared by kShared receivers beside each other.
constexpr int kSharedLight = 3;
constexpr int kShared = 8;

}  // namespace heightlight
