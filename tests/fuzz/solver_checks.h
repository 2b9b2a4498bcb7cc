#pragma once

#include <string>
#include <vector>

#include "heightlight/surface.h"

namespace heightlight {

/// Largest differences that the checks met, over all maps.
struct LargestDifferences {
  double slices_and_rays = 0;  ///< of A and α, finely sampled
  double lanes_and_twin = 0;   ///< of the sky walk's sums, per azimuth
  double gather_lanes = 0;     ///< of the gather's sums, per azimuth
  double row_sum = 0;          ///< |sky + Σ F − 1|
};

/// Finds the same answers in every way that there is, and returns what disagrees by more than may be, one
/// line each:
///  * rays in lanes and one by one end in the same places, bit for bit;
///  * exact slices and rays, which share nothing but the mesh: A and α of every fourth receiver, picked by a
///  hash;
///  * sky walks in lanes and one by one: their sums, but for rounding;
///  * gathers in lanes and one by one: their sums, but for rises that are too small to count;
///  * totals solved together and alone, with three threads and one, bit for bit;
///  * one thread and three: every operator and its gathers, bit for bit;
///  * sky + Σ F = 1 for all of them.
std::vector<std::string> compare_solvers(const Surface& surface, std::uint64_t seed,
                                         LargestDifferences& largest);

}  // namespace heightlight
