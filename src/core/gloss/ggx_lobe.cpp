#include "gloss/ggx_lobe.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/digits.h"
#include "heightlight/error.h"
#include "heightlight/occlusion_forms.h"

namespace heightlight {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// Point i of a Fibonacci lattice of `count` points, shifted around the unit square.
Eigen::Array2d lattice_point(int i, int count, const LatticeShift& shift) {
  const Eigen::Array2d point((i + 0.5) / count + shift.u, i * (std::numbers::phi - 1) + shift.v);
  return point - point.floor();
}

}  // namespace

void check_gloss(const Gloss& gloss) {
  if (!(gloss.roughness > 0 && gloss.roughness <= 1))
    throw UsageError("roughness", in_digits(gloss.roughness, 6), "must be above 0, and at most 1");
  if (!(gloss.reflectance >= 0 && gloss.reflectance <= 1))
    throw UsageError("reflectance", in_digits(gloss.reflectance, 6), "must be from 0 to 1");
}

void check_view(const Vector3& view) {
  const bool is_finite = std::isfinite(view.x) && std::isfinite(view.y) && std::isfinite(view.z);
  if (!is_finite || !(view.z > 0)) throw UsageError("view", "", "must be from above the horizontal");
}

double ggx_lobe(const Gloss& gloss, const Eigen::Vector3d& view, const Eigen::Vector3d& light) {
  const Eigen::Vector3d normal = (view + light).normalized();
  const double squared = gloss.roughness * gloss.roughness;
  const double rest = normal.z() * normal.z() * (squared - 1) + 1;
  const double distribution = squared / (std::numbers::pi * rest * rest);
  return distribution * schlick(gloss.reflectance, light.dot(normal)) *
         smith_shadowing(gloss.roughness, light.z()) * smith_shadowing(gloss.roughness, view.z()) /
         (4 * view.z());
}

void sample_ggx(const Gloss& gloss, const Eigen::Vector3d& view, int count, const LatticeShift& shift,
                std::vector<LobeSample>& samples) {
  samples.clear();
  for (int i = 0; i < count; ++i) {
    const Eigen::Array2d point = lattice_point(i, count, shift);
    const GgxDirection<double> light =
        mirror_visible_normal<double>({view.x(), view.y(), view.z()}, gloss.roughness, point.x(), point.y());
    const Direction<double>& d = light.direction;
    // The directions' density is D G₁(view)/(4 n·view). The weight is the rest: Fresnel's factor and the
    // shadowing of `light`.
    const double weight =
        d.z > 0 ? schlick(gloss.reflectance, light.facet_cosine) * smith_shadowing(gloss.roughness, d.z)
                : 0.0;
    samples.push_back({{d.x, d.y, d.z}, weight});
  }
}

void sample_lambert(int count, const LatticeShift& shift, std::vector<LobeSample>& samples) {
  samples.clear();
  for (int i = 0; i < count; ++i) {
    const Eigen::Array2d point = lattice_point(i, count, shift);
    const double radius = std::sqrt(point.x());
    samples.push_back({{radius * std::cos(kTurn * point.y()), radius * std::sin(kTurn * point.y()),
                        std::sqrt(1 - point.x())},
                       1});
  }
}

}  // namespace heightlight
