#pragma once

#include <cstdint>

#include "heightlight/transport.h"
#include "heightlight/visibility.h"

namespace heightlight {

/// The link for a place that a ray found. Beside a hole a place is on a facet's edge, and rounding may put it
/// on the missing side: there the link takes the nearest corner present, so that no weight falls on a missing
/// sample.
Link pack_link(std::uint16_t weight, const SurfacePoint& place, const Image<float>& height);

}  // namespace heightlight
