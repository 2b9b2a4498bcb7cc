#pragma once

#include <vector>

#include "heightlight/shaders.h"

namespace heightlight {

/// Functions of occlusion_forms.h that know a direction, each behind those that it calls but those of every
/// form (heightlight_share): cones in harmonics, what a glossy lobe sees by cones and by GTSO's table, and
/// straight from so many stored horizons, 3 … 360.
std::vector<ShaderFunction> gloss_functions(int horizons);

}  // namespace heightlight
