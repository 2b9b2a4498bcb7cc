#pragma once

#include <algorithm>
#include <vector>

#include "heightlight/visibility.h"
#include "visibility/walk_table.h"

// The sky of a receiver whose occluders count only within a maximum distance D.
//
// Walking outward, the receiver sees every stretch of the profile that rises above what came before. A
// stretch is seen between two slopes m and m'. What the sky would send from there counts by the share μ(d),
// where d is the distance of the stretch. With S(m) for what the sky sends from above the slope m
// (sky_walk.h), the slice's sum is
//     Σ μ(d) (S(m) − S(m')) + S(the last m).
// A stretch is seen from the point on where it passes the slope m. With a falloff, the mean of μ is taken at
// two angles between m and m'. A sharp maximum distance hides what lies inside the sphere of radius D around
// the receiver, between the slopes of the places where the stretch enters and leaves the sphere. The
// receiver's own facet is hit at once: it hides the sky whatever the maximum distance.
//
// A sharp maximum distance also has horizons of its own. A ray of elevation h > 0 passes below the surface at
// the horizontal distance t if the surface stands there under a slope s(t) ≥ tan h. The ray is t / cos h long
// there. This is no longer than D iff tan h ≤ √(D² − t²)/t. The rays that hit something within D are thus all
// those that lie below
//     max over t < D of min(s(t), √(D² − t²)/t).
// Along a straight stretch, this maximum stands at one of its ends or where the stretch leaves the sphere.
// (Below the horizontal there may be open gaps under this horizon, where rays fall steeply and far.)

namespace heightlight {

/// Throws UsageError, naming max_distance, unless the maximum distance is a number from 1e-12 to 1e12.
void check_maximum_distance(const MaximumDistance& maximum_distance);

/// The part of an azimuth's table that lies within a maximum distance.
struct DistanceTable {
  float distance = 0;  ///< D, world units
  float squared = 0;   ///< D²
  float deepest = 0;   ///< −10⁴ D: what lies deeper below a receiver counts as missing
  Falloff falloff = Falloff::none;
  std::size_t near = 0;                  ///< number of near samples up to the first one beyond D, included
  std::vector<std::vector<float>> caps;  ///< [r − 1][sample], at horizontal distances d < D: √(D² − d²)/d
};

/// Horizontal distance from the sample at `before` to the next one at `way`, at least 10⁻⁶ of `way`: where an
/// azimuth meets a vertex, two samples lie at the same place.
inline float run_between(float before, float way) { return std::max(way - before, 1e-6F * way); }

DistanceTable make_distance_table(const AzimuthTable& azimuth, const MaximumDistance& maximum_distance);

/// Number of rings that any azimuth needs for a maximum distance (world units), at most `rings`.
int rings_within(const Surface& surface, const WalkOptions& options, double distance, int rings);

}  // namespace heightlight
