#pragma once

#include "transport/gather_field.h"
#include "visibility/field_pyramid.h"
#include "windows/work.h"

namespace heightlight {

/// The total around a window, as the map's coarse levels alone have it.
struct OuterIrradiance {
  double albedo = 0;
  int level = 0;   ///< of the blocks below
  Map irradiance;  ///< E/π per block of the whole map; NaN where nothing is
};

/// Solves a level of at most a million blocks as a map of its own, and spreads that over the first coarse
/// level.
OuterIrradiance find_outer_irradiance(const Work& work, double albedo);

/// Fills a pyramid with what the gather to come looks at: the field's own in the window, the outer light
/// around it.
void fill_with_outer_irradiance(const OuterIrradiance& outer, const Surface& window, const GatherField& field,
                                FieldPyramid& pyramid);

}  // namespace heightlight
