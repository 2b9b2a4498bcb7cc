#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

// Algorithms 1 and 2 of Jimenez et al. 2016, line by line, from the horizons' polar angles on: what the
// kernels, which say the same with one arc tangent, are held to.

namespace heightlight {

/// A slice's projected normal: its length and its angle γ from the view vector, towards side 1.
struct ProjectedNormal {
  double length = 1;
  double gamma = 0;
};

/// Lines 8 to 15, for the view vector z and a slice along the azimuth φ.
inline ProjectedNormal project_normal(const Eigen::Vector3d& normal, double azimuth) {
  const Eigen::Vector3d view = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d direction(std::cos(azimuth), std::sin(azimuth), 0);
  const Eigen::Vector3d axis = direction.cross(view);
  const Eigen::Vector3d projected = normal - axis * normal.dot(axis);
  const double sign = projected.dot(direction) < 0 ? -1 : 1;
  const double cosine = std::clamp(projected.dot(view) / projected.norm(), 0.0, 1.0);
  return {projected.norm(), sign * std::acos(cosine)};
}

/// Eq. 7.
inline double inner_integral(double theta1, double theta2, double gamma) {
  return 0.25 * (-std::cos(2 * theta1 - gamma) + std::cos(gamma) + 2 * theta1 * std::sin(gamma)) +
         0.25 * (-std::cos(2 * theta2 - gamma) + std::cos(gamma) + 2 * theta2 * std::sin(gamma));
}

/// Eqs. 21 and 20: along the slice, and along the view vector.
inline Eigen::Vector2d bent_integral(double theta1, double theta2, double gamma) {
  return {(6 * std::sin(theta1 - gamma) - std::sin(3 * theta1 - gamma) + 6 * std::sin(theta2 - gamma) -
           std::sin(3 * theta2 - gamma) + 16 * std::sin(gamma) -
           3 * (std::sin(theta1 + gamma) + std::sin(theta2 + gamma))) /
              12,
          (-std::cos(3 * theta1 - gamma) - std::cos(3 * theta2 - gamma) + 8 * std::cos(gamma) -
           3 * (std::cos(theta1 + gamma) + std::cos(theta2 + gamma))) /
              12};
}

/// Line 27.
inline double clamp_to_hemisphere(double theta, double gamma) {
  return gamma + std::clamp(theta - gamma, -std::numbers::pi / 2, std::numbers::pi / 2);
}

}  // namespace heightlight
