#pragma once

#include <vector>

#include "heightlight/transport.h"
#include "transport/gather_course.h"
#include "transport/map_gather.h"

namespace heightlight {

/// Solves systems E = direct + F ρ E by gathers along few azimuths each, turned from one to the next, so that
/// what few azimuths cost washes out.
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
/// No azimuth is walked for one gather alone. The sums that belong to E_k, N_k of what is seen and W_k of the
/// weights, go on as
///     N_{k+1} = λ N_k + N[ρ (E_{k+1} − λ E_k)],   W_{k+1} = λ W_k + (1 − λ) W[…]
/// where N[x] and W are the means over the new azimuths: those that were walked before see the new field,
/// too, but for what few azimuths make of its difference from the old (Cutkosky and Orabona 2019, eq. 2, have
/// the same for gradients that are known from few samples). E_{k+1} is then A + (1 − A) N/W. λ = 0 is a
/// gather by itself; here the azimuths of all gathers weigh alike, but for a fading. The last gathers walk
/// more azimuths, since what early ones leave of noise falls with all else that is wrong.
struct ProgressiveSolution {
  std::vector<TexelVector> irradiance;  ///< of each system
  int gathers = 0;                      ///< the most of any system
};

/// How far a solution is to go.
struct ProgressiveGoal {
  double error = 0.002;  ///< RMSE wanted in all, in units of the brightest direct irradiance, of which ending
                         ///< may leave up to 0.6
  int last_azimuths =
      8;  ///< of each of the last two gathers; the third last has half of them, others a quarter. They
          ///< are planned for a radiosity of some unevenness at kPlanAlbedo: what is more uneven gets more
  double planned_unevenness = 1;
};

/// The albedo up to which a plan's error is meant.
constexpr double kPlanAlbedo = 0.8;

/// The closed form that gathers start from, E/π of a place with the sky view factor A.
double guess_total(double sky, double albedo);

/// How much more a system's radiosity, but for what bounces where the direct irradiance is one's own, varies
/// over what is seen than that of the sky at kPlanAlbedo does: both in units of their direct irradiance. 1
/// where the latter is even.
double unevenness(const IrradianceSystem& system, const Map& sky, const Surface& surface);

/// Azimuths of the last two gathers of a field that is so uneven.
int azimuths_for_unevenness(double found, const ProgressiveGoal& goal);

/// Each system's solution is the same, to the last bit, whatever others are solved beside it.
ProgressiveSolution gather_progressively(const MapGather& gather, const Map& sky,
                                         const std::vector<IrradianceSystem>& systems,
                                         const ProgressiveGoal& goal, const Watch& watch);

}  // namespace heightlight
