#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "heightlight/image.h"

namespace heightlight {

/// Values rounded to 10^−decimals, as text that a page's script unpacks: levels of 16 bits less what their
/// neighbours to the left and above let expect, low bytes first, then high ones, deflated (zlib, RFC 1950),
/// base64.
struct PackedLevels {
  std::int64_t base = 0;  ///< a level is round(value × 10^decimals) − base; 65535 where there is no value
  std::string data = {};
};

/// The most decimals that levels of 16 bits have room for, over all values, and that floats tell; negative
/// where values are large. Where there are none, 0.
int choose_decimals(const std::vector<Map>& maps);

/// The values must have room in 16 bits (choose_decimals). Infinite ones count as missing.
PackedLevels pack_levels(const Map& map, int decimals);

}  // namespace heightlight
