#pragma once

#include <vector>

#include "fit/fit_points.h"

namespace heightlight {

/// Appendix B of Jimenez et al. 2016: G = a A³ − b A² + c A at one albedo, by linear least squares.
struct AlbedoCubic {
  double albedo = 0;
  double a = 0, b = 0, c = 0;
  double rms = 0;
};

/// One per albedo of the points, which are those of a family of the cubic. Throws Error where fewer than four
/// points leave it undetermined.
std::vector<AlbedoCubic> fit_cubics(const std::vector<FitPoint>& points, const std::vector<double>& albedos);

}  // namespace heightlight
