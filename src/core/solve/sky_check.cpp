#include "solve/sky_check.h"

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "base/hash.h"
#include "base/parallel.h"
#include "base/texel_algebra.h"
#include "visibility/exact_sky.h"
#include "visibility/sky_harmonics.h"

namespace heightlight {
namespace {

constexpr int kReceivers = 256;
constexpr int kAzimuths = 256;

/// Squares of what one receiver errs by.
struct Squares {
  bool present = false;
  double ambient = 0;
  double sky = 0;
  double bent = 0;
  double harmonics = 0;
};

double squared(double x) { return x * x; }

/// Between two vectors; well-behaved for small angles.
double angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Squares compare(const ExactSky& exact, const CheckedSky& sky, std::size_t texel) {
  Squares squares;
  squares.present = true;
  const auto share = static_cast<double>(sky.sky_view_factor.values[texel]);
  squares.ambient =
      squared(static_cast<double>(sky.ambient_occlusion.values[texel]) - exact.ambient_occlusion);
  squares.sky = squared(share - exact.sky_view_factor);
  if (sky.moments.first.size() == 0) return squares;
  const Eigen::Vector3d first = as_eigen(sky.moments.first.values[texel]).cast<double>();
  squares.bent = squared(angle(first, exact.first));
  if (sky.moments.second.size() == 0) return squares;
  std::array<double, 5> second{};
  for (std::size_t k = 0; k < 5; ++k) second[k] = static_cast<double>(sky.moments.second.values[texel][k]);
  const Harmonics ours = harmonics_of_moments(share, first, second);
  const Harmonics theirs = harmonics_of_moments(exact.sky_view_factor, exact.first, exact.second);
  for (std::size_t k = 0; k < 9; ++k) squares.harmonics += squared(ours[k] - theirs[k]) / 9;
  return squares;
}

}  // namespace

std::optional<SkyCheck> check_sky(const Surface& surface, const CheckedSky& sky, std::uint64_t seed,
                                  const Watch& watch) {
  const ExactWalker walker(surface, kAzimuths);
  std::vector<Squares> all(kReceivers);
  Progress progress("check of the sky", kReceivers, watch);
  parallel_for(
      kReceivers,
      [&](std::int64_t i) {
        const std::uint64_t pick = hash_combine(seed + 3, static_cast<std::uint64_t>(i));
        const std::size_t texel = pick % surface.map.height.size();
        const auto width = static_cast<std::size_t>(surface.width());
        const ExactSky exact = find_exact_sky(walker, static_cast<int>(texel / width),
                                              static_cast<int>(texel % width), sky.reach, sky.below);
        if (!std::isnan(exact.sky_view_factor)) all[static_cast<std::size_t>(i)] = compare(exact, sky, texel);
      },
      &progress);
  SkyCheck check{0, kAzimuths, 0, 0, {}, {}};
  Squares sum;
  for (const Squares& squares : all) {
    if (!squares.present) continue;
    ++check.receivers;
    sum.ambient += squares.ambient;
    sum.sky += squares.sky;
    sum.bent += squares.bent;
    sum.harmonics += squares.harmonics;
  }
  if (check.receivers == 0) return std::nullopt;
  const auto root_mean = [&](double squares) { return std::sqrt(squares / check.receivers); };
  check.ambient_occlusion = root_mean(sum.ambient);
  check.sky_view_factor = root_mean(sum.sky);
  if (sky.moments.first.size() > 0) check.bent_normal_rad = root_mean(sum.bent);
  if (sky.moments.second.size() > 0) check.harmonics = root_mean(sum.harmonics);
  return check;
}

}  // namespace heightlight
