#include "gloss/ggx_lobe.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/digits.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// Smith's G₁ of GGX (Walter et al. 2007, eq. 34), of a direction by its cosine: 2/(1 + √(1 + r² tan²θ)).
double smith_shadowing(double roughness, double cosine) {
  const double tangent_squared = (1 - cosine * cosine) / (cosine * cosine);
  return 2 / (1 + std::sqrt(1 + roughness * roughness * tangent_squared));
}

/// Schlick's form, of the cosine between light and microfacet.
double fresnel(double reflectance, double cosine) {
  const double rest = 1 - std::min(cosine, 1.0);
  const double squared = rest * rest;
  return reflectance + (1 - reflectance) * squared * squared * rest;
}

/// Point i of a Fibonacci lattice of `count`, shifted around the unit square.
Eigen::Array2d lattice_point(int i, int count, const LatticeShift& shift) {
  const Eigen::Array2d point((i + 0.5) / count + shift.u, i * (std::numbers::phi - 1) + shift.v);
  return point - point.floor();
}

/// A normal of the hemisphere as seen along `view` (Heitz 2018, section 3.2), both in units of the roughness:
/// a point of the disc, half of which foreshortens with the view, projected onto the hemisphere.
Eigen::Vector3d visible_normal(const Eigen::Vector3d& view, const Eigen::Array2d& point) {
  const double length = std::hypot(view.x(), view.y());
  const Eigen::Vector3d across = length > 0 ? Eigen::Vector3d(-view.y() / length, view.x() / length, 0)
                                            : Eigen::Vector3d(Eigen::Vector3d::UnitX());
  const Eigen::Vector3d along = view.cross(across);
  const double radius = std::sqrt(point.x());
  const double first = radius * std::cos(kTurn * point.y());
  const double share = 0.5 * (1 + view.z());
  const double second = (1 - share) * std::sqrt(std::max(0.0, 1 - first * first)) +
                        share * radius * std::sin(kTurn * point.y());
  const double third = std::sqrt(std::max(0.0, 1 - first * first - second * second));
  return first * across + second * along + third * view;
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
  return distribution * fresnel(gloss.reflectance, light.dot(normal)) *
         smith_shadowing(gloss.roughness, light.z()) * smith_shadowing(gloss.roughness, view.z()) /
         (4 * view.z());
}

void sample_ggx(const Gloss& gloss, const Eigen::Vector3d& view, int count, const LatticeShift& shift,
                std::vector<LobeSample>& samples) {
  const double r = gloss.roughness;
  const Eigen::Vector3d stretched = Eigen::Vector3d(r * view.x(), r * view.y(), view.z()).normalized();
  samples.clear();
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d seen = visible_normal(stretched, lattice_point(i, count, shift));
    const Eigen::Vector3d normal =
        Eigen::Vector3d(r * seen.x(), r * seen.y(), std::max(seen.z(), 1e-12)).normalized();
    const Eigen::Vector3d light = 2 * view.dot(normal) * normal - view;
    // The density of light is D G₁(view)/(4 n·view), which leaves Fresnel's factor and the light's shadowing.
    const double weight =
        light.z() > 0 ? fresnel(gloss.reflectance, light.dot(normal)) * smith_shadowing(r, light.z()) : 0.0;
    samples.push_back({light, weight});
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
