#pragma once

#include "heightlight/transport.h"
#include "visibility/exact_walk.h"

namespace heightlight {

/// Σ F x over what an exact walk saw, x interpolated linearly at each place. `x` is finite everywhere; values
/// at missing samples weigh in only where rounding puts a place beyond a hole's edge.
double gather_exactly(const SliceView& view, const TexelVector& x, const Surface& surface);

}  // namespace heightlight
