#pragma once

#include <array>
#include <string>
#include <vector>

#include "heightlight/sky_light.h"
#include "visibility/sky_harmonics.h"

namespace heightlight {

/// A sky under which ways to shade are compared.
struct NamedSky {
  std::string name = {};
  SkyLight light = {};  ///< in units of what a level plane receives, E/π
};

/// uniform and overcast, as `bake` knows them; low-sun, a glow 12° high over a dim sky; binary, light and
/// dark patches of 30° with sharp edges. The last two are dark below the horizontal.
std::vector<NamedSky> compared_skies();

/// ∫ L Y_lm dω, red, green and blue.
std::array<Harmonics, 3> project_sky(const SkyLight& sky);

}  // namespace heightlight
