#pragma once

#include <vector>

#include "method.h"

namespace heightlight {

/// Methods for the sky view factor by horizon walks. There is one method per number of samples per octave,
/// whose setting is the number of azimuths; the last method is given an error and plans the rest. The surface
/// must outlive them.
std::vector<Method> horizon_sky_methods(const Surface& surface);

/// Irradiance of all bounces at a constant albedo, by horizon walks that are planned for an error of the
/// total alone.
Method horizon_total_method(const Surface& surface, double albedo);

}  // namespace heightlight
