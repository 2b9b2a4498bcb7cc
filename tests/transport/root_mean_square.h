#pragma once

#include <cmath>

#include "heightlight/transport.h"

namespace heightlight {

/// Root mean square over the texels.
inline double rms(const TexelVector& x) { return x.norm() / std::sqrt(static_cast<double>(x.size())); }

}  // namespace heightlight
