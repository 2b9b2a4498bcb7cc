#pragma once

#include <Eigen/Core>
#include <array>

namespace heightlight {

/// Coefficients over the nine real spherical harmonics of l ≤ 2, in the order Y00, Y1−1, Y10, Y11, Y2−2,
/// Y2−1, Y20, Y21, Y22: orthonormal, without the Condon–Shortley phase, z the pole.
using Harmonics = std::array<double, 9>;

/// Y_lm of a unit vector.
Harmonics harmonics_of(const Eigen::Vector3d& direction);

/// (1/π) ∫ V Y_lm cosθ dω from the moments of the same weight: of 1 (A), ω, and x² − y², xy, z², xz, yz.
Harmonics harmonics_of_moments(double sky_view_factor, const Eigen::Vector3d& first,
                               const std::array<double, 5>& second);

/// The same in axes whose y points the other way.
Harmonics turn_y(const Harmonics& harmonics);

/// Σ a b: the mean radiance that comes in, weighted by V cosθ/π, where `sky` holds the sky's coefficients.
double dot(const Harmonics& a, const Harmonics& b);

}  // namespace heightlight
