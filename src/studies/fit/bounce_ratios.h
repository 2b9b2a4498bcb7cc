#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "heightlight/curves.h"

namespace heightlight {

/// What the bounces of like α say about τ, the ratio of each to the one before (Patapom, eqs. 8 to 9), which
/// the notes take for one number.
struct RatioBin {
  double ao = 0;  ///< mean α
  std::size_t count = 0;
  std::vector<double> ratios;  ///< E_{b+1}/E_b, b = 1 … K − 1; NaN from where the bounce is less than 1e-4
  double by_conservation = 0;  ///< eq. 9 on the data: 1 − E₁/(1 − E₀); NaN where E₀ = 1
  double published = 0;        ///< eq. 9 with the published F₀ and F₁; NaN where F₀ ≥ 1
};

/// The ratios of one map.
struct BounceRatios {
  std::string map;
  std::vector<RatioBin> bins;  ///< those that hold at least 1/1000 of the texels
  /// How far τ is from one number: the difference between the greatest and the least ratio of a bin's first
  /// ten, averaged over the bins, each weighing as its texels times what bounces bring them, 1 − E₀.
  double spread = 0;
};

BounceRatios find_bounce_ratios(const std::string& map, const BounceCurves& over_alpha);

/// The bin nearest to an α; null where none is within 0.05.
const RatioBin* find_bin(const BounceRatios& ratios, double alpha);

}  // namespace heightlight
