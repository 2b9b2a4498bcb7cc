#pragma once

#include <string>

#include "heightlight/heightmap.h"

namespace heightlight {

/// A tiny map of a random kind (rough, terraced, level, spiked, pitted, walled, smooth), size, spacing,
/// boundary, relief (10⁻³ to 10² times the width) and share of missing samples; at least one sample is
/// present.
struct RandomMap {
  Heightmap map;
  std::string description;
};

/// The same for the same seed, everywhere.
RandomMap make_random_map(std::uint64_t seed);

}  // namespace heightlight
