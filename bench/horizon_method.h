#pragma once

#include <vector>

#include "method.h"

namespace heightlight {

/// Sky view factor by horizon walks: one method per number of samples per octave, whose setting is the number
/// of azimuths, and last the one that is told an error and plans the rest. The surface must outlive them.
std::vector<Method> horizon_sky_methods(const Surface& surface);

/// Irradiance of all bounces at a constant albedo, by horizon walks planned for an error of that alone.
Method horizon_total_method(const Surface& surface, double albedo);

}  // namespace heightlight
