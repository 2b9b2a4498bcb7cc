#pragma once

#include <algorithm>
#include <vector>

#include "heightlight/visibility.h"
#include "visibility/walk_table.h"

// Skies of which only occluders within a maximum distance D hide anything.
//
// Walking outward, every stretch of the profile that rises above what came before is seen between two slopes
// m and m', and what the sky would send from there counts by the stretch's distance d:
//     Σ μ(d) (S(m) − S(m')) + S(the last m).
// A stretch is seen from where it passes the slope m on. With a falloff the mean of μ is taken of two angles
// between m and m'. A sharp maximum distance hides what lies inside the sphere of radius D around the
// receiver, between the slopes of the places where the stretch enters and leaves it. The receiver's own facet
// is hit at once: it hides whatever the maximum distance.
//
// A sharp maximum distance has horizons of its own, too. A ray of elevation h > 0 passes below the surface at
// the horizontal distance t where that stands under the slope s(t) ≥ tan h, and is t / cos h long there: no
// longer than D iff tan h ≤ √(D² − t²)/t. What it hits within D is thus all that lies below
//     max over t < D of min(s(t), √(D² − t²)/t),
// which along a straight stretch stands at its ends, or where it leaves the sphere. (Below the horizontal
// there may be gaps under it, where rays fall steeply and far.)

namespace heightlight {

/// Throws UsageError, naming max_distance, unless the maximum distance is positive and finite.
void check_maximum_distance(const MaximumDistance& maximum_distance);

/// What of an azimuth's table lies within a maximum distance.
struct DistanceTable {
  float distance = 0;  ///< D
  float squared = 0;   ///< D²
  float deepest = 0;   ///< what lies deeper below a receiver than 10⁴ D is as good as missing
  Falloff falloff = Falloff::none;
  std::size_t near = 0;                  ///< near samples up to the first beyond D
  std::vector<std::vector<float>> caps;  ///< √(D² − d²)/d of ring samples nearer than D: [r − 1][sample]
};

/// Way from one sample to the next. Where an azimuth meets a vertex, two samples lie there.
inline float run_between(float before, float way) { return std::max(way - before, 1e-6F * way); }

DistanceTable make_distance_table(const AzimuthTable& azimuth, const MaximumDistance& maximum_distance);

/// Rings that any azimuth needs for a maximum distance, at most `rings`.
int rings_within(const Surface& surface, const WalkOptions& options, double distance, int rings);

}  // namespace heightlight
