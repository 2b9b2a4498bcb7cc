#pragma once

#include <vector>

#include "bake/bake.h"
#include "visibility/horizon_sky.h"

namespace heightlight {

/// What of the sky the maps of a bake want.
SkyWanted sky_wanted(const BakeOptions& options);

/// Maps that are kept of a window's sky: A, α, and the components of the moments that are wanted.
std::vector<Map> kept_sky_maps(const HorizonSky& sky, const BakeOptions& options);

/// Their number.
inline int kept_sky_count(const SkyWanted& wanted) {
  return 2 + (wanted.first ? 3 : 0) + (wanted.second ? 5 : 0);
}

/// The same backwards; `maps` as kept_sky_maps has them.
HorizonSky sky_of_maps(std::vector<Map> maps, const BakeOptions& options);

}  // namespace heightlight
