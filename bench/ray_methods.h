#pragma once

#include "method.h"
#include "visibility/ray_caster.h"

namespace heightlight {

/// The sky view factor of each receiver, by the caster's rays.
std::vector<float> trace_sky(const RayCaster& caster, const Receivers& receivers);

/// Sky view factor by our rays. The surface must outlive the method.
Method ray_sky_method(const Surface& surface);

/// Irradiance of all bounces at a constant albedo, by our rays, each of which stores a link.
Method ray_total_method(const Surface& surface, double albedo);

}  // namespace heightlight
