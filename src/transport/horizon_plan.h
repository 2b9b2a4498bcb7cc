#pragma once

#include "transport/horizon_pilot.h"

namespace heightlight {

/// The sky's part of a plan for an RMSE of A of `error`, the azimuths given where `azimuths` > 0.
HorizonPlan plan_sky(HorizonPilot& pilot, double error, int azimuths);

/// The links' part, once the direct light is known, for an RMSE of the total of `error`. `light` is filled
/// with it.
void plan_links(HorizonPilot& pilot, const LightMips& light, const TexelVector& direct, double error,
                HorizonPlan& plan);

}  // namespace heightlight
