#pragma once

#include <cmath>

#include "heightlight/surface.h"

namespace heightlight {

/// A and α of one receiver as ExactWalker defines them, found by other means.
struct TwinSky {
  long double sky_view_factor = 0;
  long double ambient_occlusion = 0;
};

/// The readable, slow twin of exact walks in extended precision (a significand of 64 bits where the machine
/// has one): every crossing of every azimuth's line with the mesh's edges is looked at, none is skipped, and
/// the slices' integrals are taken as they stand in the derivation. For small maps. The receiver must be
/// present.
TwinSky twin_sky(const Surface& surface, int row, int column, int azimuths);

}  // namespace heightlight
