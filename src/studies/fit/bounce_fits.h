#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "fit/form_family.h"
#include "fit/judged_map.h"
#include "heightlight/watch.h"

namespace heightlight {

/// The notes' form of one bounce (Patapom, "Summing the curves"), E_b/π = A α (1 − α)^1.5 exp(−B α^C), with
/// all three constants free; at b = 1 and C = ¼ it is F₁.
struct BounceFit {
  std::size_t bounce = 1;
  std::array<double, 3> constants = {};  ///< A, B, C
  std::array<double, 3> low = {};        ///< 95 % intervals, of the bootstrap; of A up to 1e9
  std::array<double, 3> high = {};
  double rms = 0;
  double peak = 0;    ///< greatest bin mean: what the RMS is to be held against
  std::string fault;  ///< why it could not be fitted, or A runs away; empty where it could
};

/// The form at constants A, B, C; α in [0, 1].
double evaluate_bounce(const std::array<double, 3>& constants, double alpha);

/// The family of a bounce's form: ln A, B and C, starting from those given. The logarithm, since A spans
/// decades.
FormFamily make_bounce_family(std::size_t bounce, const std::array<double, 3>& start);

/// Bounces 1 … K of all maps together, K the fewest that one has, each fit starting from the one before;
/// intervals from `draws` draws.
std::vector<BounceFit> fit_bounces(const std::vector<JudgedMap>& maps, int draws, std::uint64_t seed,
                                   const Watch& watch);

}  // namespace heightlight
