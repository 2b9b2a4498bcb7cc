#pragma once

#include <cstdint>

#include "heightlight/transport.h"
#include "heightlight/visibility.h"

namespace heightlight {

/// Returns the link to a place that a ray or an exact walk found. Beside a hole the place lies on a facet's
/// edge, and rounding may move it to the missing side. There the link takes the nearest corner that is
/// present, so that no weight falls on a missing sample.
Link pack_link(std::uint16_t weight, const SurfacePoint& place, const Image<float>& height);

}  // namespace heightlight
