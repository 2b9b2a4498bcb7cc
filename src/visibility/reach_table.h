#pragma once

#include <vector>

#include "heightlight/visibility.h"
#include "visibility/walk_table.h"

// Horizons of which only occluders within a reach D count.
//
// A ray of elevation h > 0 passes below the surface at the horizontal distance t where that stands under the
// slope s(t) ≥ tan h, and is t / cos h long there: no longer than D iff tan h ≤ √(D² − t²)/t. What it hits
// within D is thus all that lies below
//     max over t < D of min(s(t), √(D² − t²)/t),
// a horizon again. Along a straight stretch of the profile the greatest minimum stands at its ends, or where
// the stretch leaves the sphere of radius D around the receiver, which is where both are equal. (A horizon
// below the horizontal is taken to hide everything under it, though rays that fall more steeply may be longer
// than D: on slopes, and by little.)
//
// With a falloff the open share is ∫ μ'(s) A_s ds, A_s being that of the sharp reach s (file 002 eq. 7). With
// s = D u (linear) or D u² (root) it is the plain mean of A_s over u in [0, 1]: a few Gauss nodes.

namespace heightlight {

/// A sharp reach, and its share in the mean.
struct ReachNode {
  double distance = 0;
  float weight = 1;
};

/// Gauss nodes of the mean, by rising distance. Eight leave 10⁻³ of A at most on a brick wall.
constexpr int kReachNodes = 8;

/// One node without falloff, else `nodes`. Throws UsageError, naming `--max-distance`, unless the reach is
/// positive and finite.
std::vector<ReachNode> reach_nodes(const Reach& reach, int nodes = kReachNodes);

/// What of an azimuth's table lies within a sharp reach.
struct ReachTable {
  float squared = 0;     ///< D²
  float deepest = 0;     ///< what lies deeper below a receiver than 10⁴ D is as good as missing
  std::size_t near = 0;  ///< near samples up to the first beyond D
  std::vector<std::vector<float>> caps;  ///< √(D² − d²)/d of ring samples nearer than D: [l − 1][sample]
};

ReachTable make_reach_table(const AzimuthTable& azimuth, double distance);

/// Rings that any azimuth needs for a reach, at most `rings`.
int rings_within(const Surface& surface, const WalkOptions& options, double distance, int rings);

}  // namespace heightlight
