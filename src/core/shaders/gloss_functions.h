#pragma once

#include <vector>

#include "heightlight/shaders.h"

namespace heightlight {

/// The shader functions of occlusion_forms.h that depend on a direction, each after the functions that it
/// calls, without those that every form needs (heightlight_share): cones in harmonics; what a glossy lobe
/// sees by cones, by GTSO's table, and directly from `horizons` stored horizons, 3 … 360.
std::vector<ShaderFunction> gloss_functions(int horizons);

}  // namespace heightlight
