#pragma once

#include <string>

#include "heightlight/image.h"

namespace heightlight {

/// Of specular occlusion: "135,30", azimuth clockwise from north, which is up the map, and elevation above
/// the horizontal, of the viewer, in degrees. A unit vector in world axes. Throws UsageError for anything
/// else, and for a view from the horizontal or below.
Vector3 parse_view(const std::string& text);

/// "0.13". Throws UsageError for a text that is no number, or a roughness outside (0, 1].
double parse_roughness(const std::string& text);

}  // namespace heightlight
