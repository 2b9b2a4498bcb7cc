#pragma once

#include <vector>

#include "heightlight/transport.h"
#include "transport/map_gather.h"

namespace heightlight {

/// Solves systems E = direct + F ρ E by gathers along few azimuths each, turned by the golden ratio from one
/// to the next, so that what few azimuths cost washes out and no walk is wasted.
///
/// The start is a closed form. A gather then takes E to direct + F ρ E, of which the part that is wrong falls
/// by the eigenvalues of F ρ. These are real, since F is symmetric when texels weigh their area, and lie
/// between −κ and κ; Chebyshev's weights (Golub and Varga 1961, eq. 2.13)
///     E_{k+1} = E_{k−1} + w_{k+1} (direct + F ρ E_k − E_{k−1}),   w_1 = 1, w_2 = 1/(1 − κ²/2),
///     w_{k+1} = 1/(1 − κ² w_k/4)
/// make it fall by q = (1 − √(1 − κ²))/κ, not κ, from one gather to the next. What lives longest is what is
/// deepest: κ is taken as ρ times the mean of 1 − A, weighted by its fourth power and area, which tells how
/// much of the surface those places see that see most of it. (Of the κ tried, the best was within 0.1 of that
/// on bricks at reliefs of .1 and .4, bowls and trenches, at ρ of .8 and .95; with fewer powers deep wells,
/// with more the open ground takes a gather or two longer.)
///
/// The last gathers walk more azimuths. The sums of the last two are taken together, and the last weighs 1.
struct ProgressiveSolution {
  std::vector<TexelVector> irradiance;  ///< of each system
  int gathers = 0;                      ///< the most of any system
};

/// How far a solution is to go.
struct ProgressiveGoal {
  double error =
      0.002;  ///< RMSE wanted in all, in units of the brightest light, of which ending may leave half
  int last_azimuths =
      8;  ///< of each of the last two gathers; the third last has half of them, others a quarter
};

/// Each system's solution is the same, to the last bit, whatever others are solved beside it.
ProgressiveSolution gather_progressively(const MapGather& gather, const Map& sky,
                                         const std::vector<LightSystem>& systems, const ProgressiveGoal& goal,
                                         const Watch& watch);

}  // namespace heightlight
