#pragma once

#include <string>
#include <vector>

#include "heightlight/heightmap.h"

namespace heightlight {

/// A small map on which something might break.
struct HardMap {
  std::string name;
  Heightmap map;
};

/// Every shape of trouble, most of them under both boundaries: relief from 10⁻⁹ to 10⁶ times the width, pits,
/// spikes, slits, cliffs, checkerboards, terraces, level and denormal heights, wells, grazing horizons,
/// creases, maps of one sample, row or column, sizes that no vector divides, tiles that do not match, holes,
/// islands.
std::vector<HardMap> hard_maps();

}  // namespace heightlight
