#pragma once

#include <vector>

#include "heightlight/curves.h"
#include "heightlight/heightmap.h"
#include "heightlight/transport.h"
#include "heightlight/watch.h"

namespace heightlight {

/// One relief of a study of the height amplitude.
struct ReliefCurves {
  double relief_share = 0;  ///< peak-to-valley height over the map's width
  BounceCurves curves;      ///< over α
  int width = 0;            ///< texels of the copy that they are of
  int height = 0;
};

/// What is studied.
struct ReliefStudy {
  std::vector<double> relief_shares;  ///< positive, finite
  int largest_side = 128;             ///< of the copy that the study runs on
  int bounces = 1;
  int bins = 40;
};

/// How the study walks: fine enough that the error does not show among the curves.
const HorizonPlan& study_plan();

/// The notes' study of the height amplitude (Patapom): curves over α of the map with its heights scaled so
/// that its relief is each share of its width (spacing × columns). Runs on a copy of at most `largest_side`
/// texels a side, which keeps the map's extent and boundary, since only the curves' shape is asked: every
/// n-th sample, or as near to it as a side that n does not divide allows. A level map stays level. Throws
/// UsageError for a share that is not positive and finite, largest_side < 1 or bounces < 1, and what solve
/// and CurveBuilder throw.
std::vector<ReliefCurves> study_reliefs(const Heightmap& map, const ReliefStudy& study,
                                        const Watch& watch = {});

}  // namespace heightlight
