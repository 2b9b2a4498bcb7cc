#pragma once

#include <cstdint>
#include <vector>

#include "heightlight/image.h"
#include "heightlight/surface.h"
#include "heightlight/watch.h"

// Light of a sky that is not the same all over: radiance by direction.
//
// An image of all directions, latitude by longitude: rows go from the zenith down to the nadir, and columns
// around, as a panorama has them that looks to +y (the map's top) in the middle and to +x (its right) at
// three quarters. Of a texel, all directions have its radiance. What lies below the horizontal is seen by
// open maps alone.

namespace heightlight {

/// Red, green and blue (x, y, z of a value) of the radiance, in any unit that a result is wanted in.
struct SkyLight {
  Image<Vector3> radiance;
};

/// Throws UsageError unless the image has two columns to a row, at least 2 × 1 texels, and its radiance is
/// finite and nowhere negative.
void check_sky_light(const SkyLight& sky);

/// Warm (1, 0.6, 0.3) where y > 0 and cold (0.3, 0.6, 1) elsewhere.
SkyLight two_tone_sky();

/// The overcast sky of the CIE, in units of what a level plane receives, E/π: from horizon to zenith it
/// brightens threefold, L = 9/7 (1 + 2 sinθ)/3 (Moon and Spencer 1942); below the horizontal it is dark.
SkyLight overcast_sky();

/// How a sky's direct irradiance is found.
struct SkyAccuracy {
  double error = 0.002;    ///< RMSE wanted of E₀/π in the channel that errs most
  int azimuths = 0;        ///< > 0: fixed, even; else doubled from 64 until the check finds the error, or 512
  std::uint64_t seed = 1;  ///< of the receivers that are checked
  Watch watch = {};
};

/// Direct light of a sky.
struct SkyIrradiance {
  std::vector<TexelVector> channels;  ///< E₀/π, red, green, blue; one where the sky is grey; 0 where missing
  int azimuths = 0;
  double rmse = 0;  ///< of the channel that errs most, on 128 receivers picked by a hash, by exact horizons
};

/// What every receiver gets of a sky directly, over horizons of fast walks, each of which stands for its
/// slice of azimuths. What lies below the horizontal shines, too, where nothing is in the way. The same to
/// the last bit for any number of threads. Throws UsageError as check_sky_light does, Cancelled when the
/// watch says so.
SkyIrradiance sky_irradiance(const Surface& surface, const SkyLight& sky, const SkyAccuracy& accuracy = {});

/// Bytes that finding it takes beside what it returns.
std::uint64_t sky_irradiance_bytes(const Surface& surface, const SkyLight& sky);

/// Of the texel in that direction, which need not be a unit vector; not 0.
Vector3 radiance_from(const SkyLight& sky, const Vector3& direction);

/// What planes with nothing in their way receive, E/π, by the direction of their normals: an image as that of
/// the radiance, of 2 rows × rows texels. This is what a renderer calls a prefiltered sky. Each value is
/// exact but for sums over directions of a quarter of a texel of its own.
SkyLight open_irradiance(const SkyLight& sky, int rows);

/// Between the middles of texels.
Vector3 look_up(const SkyLight& sky, const Vector3& direction);

/// A sky as a renderer holds it to look up the radiance of many directions: an octahedron's faces unfolded
/// into a square of side × side cells, whose middle is the zenith and whose corners are the nadir.
struct SkyGrid {
  int side = 0;
  std::vector<float> red, green, blue;  ///< row by row
};

/// Each cell has the sky's mean over the spherical cap of that solid angle (sr, in (0, 2π]) around it: what a
/// direction sees that stands for so much of the sphere. Ritschel et al. 2009 asks for it in section 6:
/// "High-frequency environment maps require either pre-smoothing or higher sampling rates."
SkyGrid make_sky_grid(const SkyLight& sky, double solid_angle);

/// In units of what a level plane with nothing in its way receives, E/π, its three channels' mean. A sky
/// without any light stays dark.
SkyLight normalised(SkyLight sky);

}  // namespace heightlight
