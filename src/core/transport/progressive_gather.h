#pragma once

#include <vector>

#include "heightlight/transport.h"
#include "transport/gather_course.h"
#include "transport/map_gather.h"

namespace heightlight {

/// Solves systems E = direct + F ρ E by gathers along few azimuths each, turned from one to the next, so that
/// the errors of few azimuths average out.
///
/// The start is a closed form. A gather then takes E to direct + F ρ E, and the error of E shrinks by the
/// eigenvalues of F ρ. These are real, since F is symmetric when texels are weighted by their area, and lie
/// between −κ and κ. Chebyshev's weights (Golub and Varga 1961, eq. 2.13)
///     E_{k+1} = E_{k−1} + w_{k+1} (direct + F ρ E_k − E_{k−1}),   w_1 = 1, w_2 = 1/(1 − κ²/2),
///     w_{k+1} = 1/(1 − κ² w_k/4)
/// make the error shrink by q = (1 − √(1 − κ²))/κ, instead of κ, from one gather to the next. The error
/// persists longest in the deepest places. κ is taken as ρ times the mean of 1 − A, weighted by its fourth
/// power and area, which tells how much of the surface is seen by the places that see most of it. (Of the κ
/// tried, the best was within 0.1 of that on bricks at reliefs of .1 and .4, bowls and trenches, at ρ of .8
/// and .95. With a lower power deep wells take a gather or two longer; with a higher power open ground does.)
///
/// No azimuth is walked for one gather alone. The sums that belong to E_k, N_k of what is seen and W_k of the
/// weights, continue as
///     N_{k+1} = λ N_k + N[ρ (E_{k+1} − λ E_k)],   W_{k+1} = λ W_k + (1 − λ) W[…]
/// where N[x] and W are the means over the new azimuths. The azimuths walked before thus see the new field,
/// too, except for the error that few azimuths make in its difference from the old field (Cutkosky and
/// Orabona 2019, eq. 2, do the same for gradients that are known from few samples). The gather direct + F ρ
/// E_k is then direct + (1 − A) N_k/W_k. λ = 0 would make each gather independent; here the azimuths of all
/// gathers have the same weight, except that old ones fade. The last gathers walk more azimuths, since the
/// noise that early gathers leave shrinks with the rest of the error.
struct ProgressiveSolution {
  std::vector<TexelVector> irradiance;  ///< E/π of each system
  int gathers = 0;                      ///< number of gathers, the most of any system
};

/// What a solution is to reach.
struct ProgressiveGoal {
  double error = 0.002;   ///< RMSE wanted in all, in units of the brightest direct irradiance; ending the
                          ///< gathers may leave up to 0.6 of it
  int last_azimuths = 8;  ///< azimuths of each of the last two gathers; the third last has half as many,
                          ///< earlier ones a quarter. They are planned for a radiosity of
                          ///< `planned_unevenness` at kPlanAlbedo: a more uneven one gets more
  double planned_unevenness = 1;
};

/// The albedo up to which the error of a plan holds.
constexpr double kPlanAlbedo = 0.8;

/// The closed form that gathers start from: E/π of a place with the sky view factor `sky`.
double guess_total(double sky, double albedo);

/// Ratio of two standard deviations over what is seen: of the system's starting radiosity, without bounces
/// where the direct irradiance is user-given, and of the sky's radiosity at kPlanAlbedo; both in units of
/// their direct irradiance. 1 where the latter is even.
double unevenness(const IrradianceSystem& system, const Map& sky, const Surface& surface);

/// Azimuths of each of the last two gathers of a field of that unevenness.
int azimuths_for_unevenness(double found, const ProgressiveGoal& goal);

/// Solves all systems by gathers over one map. Each system's solution is the same, to the last bit, whatever
/// others are solved beside it.
ProgressiveSolution gather_progressively(const MapGather& gather, const Map& sky,
                                         const std::vector<IrradianceSystem>& systems,
                                         const ProgressiveGoal& goal, const Watch& watch);

}  // namespace heightlight
