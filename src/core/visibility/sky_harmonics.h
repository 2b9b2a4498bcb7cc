#pragma once

#include <Eigen/Core>
#include <array>

#include "heightlight/occlusion_forms.h"

namespace heightlight {

/// Nine harmonics in double precision. `dot` of what harmonics_of_moments returns and the harmonics of a
/// sky's radiance is the mean radiance that comes in, weighted by V cosθ/π.
using Harmonics = NineHarmonics<double>;

/// The nine Y_lm of a unit vector.
Harmonics harmonics_of(const Eigen::Vector3d& direction);

/// (1/π) ∫ V Y_lm cosθ dω, from moments with the same weight: of 1 (A), of ω (`first`), and of x² − y², xy,
/// z², xz, yz (`second`).
Harmonics harmonics_of_moments(double sky_view_factor, const Eigen::Vector3d& first,
                               const std::array<double, 5>& second);

/// The same harmonics in axes whose y points the other way.
Harmonics turn_y(const Harmonics& harmonics);

}  // namespace heightlight
