#pragma once

#include "heightlight/image.h"

namespace heightlight {

// A cone of half-angle β around the normal stands for what is open. Cosine weighted, with u = cos β,
//     A = sin²β = 1 − u²,   (1/π) |∫ ω cosθ dω| = 2/3 (1 − u³),
// so that the mean of its directions has the length R = 2/3 (1 + u + u²)/(1 + u), from 2/3 (a hemisphere) to
// 1 (a ray).

/// β in [0, π/2] of the cone that is as open: cos β = √(1 − A) (Jimenez et al. 2016, eq. 22).
double cone_of_openness(double sky_view_factor);

/// β of the cone whose directions are spread as much: R = |first| / A. Directions that are spread more than
/// those of a hemisphere, as along a ditch, make one.
double cone_of_spread(double sky_view_factor, const Vector3& first);

}  // namespace heightlight
