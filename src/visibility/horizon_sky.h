#pragma once

#include "heightlight/image.h"
#include "visibility/height_mips.h"
#include "visibility/walk_table.h"

namespace heightlight {

/// The sky's share of every receiver, by horizon walks; NaN where the sample is missing.
struct HorizonSky {
  Map ambient_occlusion;  ///< α, [0, 1]
  Map sky_view_factor;    ///< A, [0, 1]
};

HorizonSky walk_horizon_sky(const Surface& surface, const HeightMips& mips, const WalkOptions& options,
                            bool quiet);

}  // namespace heightlight
