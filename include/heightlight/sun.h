#pragma once

#include <numbers>

#include "heightlight/image.h"
#include "heightlight/surface.h"
#include "heightlight/watch.h"

namespace heightlight {

/// A disc of even radiance in the sky, far away.
struct Sun {
  double azimuth_rad = 0;    ///< of its middle, counterclockwise from x
  double elevation_rad = 0;  ///< of its middle above the horizontal, in [0, π/2]
  /// The sun's own in the mean is 0.533 degrees; in [0, 0.1], 0: a point.
  double diameter_rad = 0.533 * std::numbers::pi / 180;
};

/// Throws UsageError naming the quantity: a sun that stands below the horizontal or beyond the zenith, or a
/// diameter out of its range.
void check_sun(const Sun& sun);

/// Direct irradiance of the sun alone per texel, in units of what a plane that faces it has, so that a level
/// open plain receives sin(elevation). This is E₀/π as Wanted::direct takes it; 0 where the sample is
/// missing. Horizons are exact; penumbras are those of the disc, cut into upright chords: a level edge errs
/// by up to 0.0005 of the sun, an upright one by up to 0.042, of either sign.
///
/// Takes the result, 8 bytes per texel, and a maximum pyramid of the surface, up to 11. The same to the last
/// bit for any number of threads. Throws UsageError as check_sun does, Cancelled when the watch says so.
TexelVector sun_irradiance(const Surface& surface, const Sun& sun, const Watch& watch = {});

}  // namespace heightlight
