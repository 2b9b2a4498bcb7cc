#pragma once

#include <cstdint>

#include "heightlight/surface.h"

namespace heightlight {

/// The occlusion that games bake for what is far (Jimenez et al. 2016, section 4.3): A of the map at an
/// eighth of its resolution, by means, found by a planned walk and brought back bilinearly. NaN where the
/// map's sample is missing. Maps of fewer than 16 texels a side have no such level: then it is 1.
Map bake_far_field(const Surface& surface, std::uint64_t memory);

}  // namespace heightlight
