#include "solve/sky_check.h"

#include <Eigen/Geometry>
#include <atomic>
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

Squares compare(const ExactSky& exact, const CheckedReceiver& sky) {
  Squares squares;
  squares.present = true;
  const auto share = static_cast<double>(sky.sky_view_factor);
  squares.ambient = squared(static_cast<double>(sky.ambient_occlusion) - exact.ambient_occlusion);
  squares.sky = squared(share - exact.sky_view_factor);
  if (sky.moments.first.size() == 0) return squares;
  const Eigen::Vector3d first = as_eigen(sky.moments.first.values[0]).cast<double>();
  squares.bent = squared(angle(first, exact.first));
  if (sky.moments.second.size() == 0) return squares;
  std::array<double, 5> second{};
  for (std::size_t k = 0; k < 5; ++k) second[k] = static_cast<double>(sky.moments.second.values[0][k]);
  const Harmonics ours = harmonics_of_moments(share, first, second);
  const Harmonics theirs = harmonics_of_moments(exact.sky_view_factor, exact.first, exact.second);
  for (std::size_t k = 0; k < 9; ++k) squares.harmonics += squared(ours[k] - theirs[k]) / 9;
  return squares;
}

}  // namespace

std::optional<SkyCheck> check_sky(const Surface& surface, const CheckedSky& sky, std::uint64_t seed,
                                  const Watch& watch) {
  const ExactWalker walker(surface, kSkyCheckAzimuths);
  const auto found = [&](int row, int column) {
    const std::size_t texel = surface.map.height.index(row, column);
    CheckedReceiver receiver{.ambient_occlusion = sky.ambient_occlusion.values[texel],
                             .sky_view_factor = sky.sky_view_factor.values[texel]};
    if (sky.moments.first.size() > 0) receiver.moments.first = {1, 1, sky.moments.first.values[texel]};
    if (sky.moments.second.size() > 0) receiver.moments.second = {1, 1, sky.moments.second.values[texel]};
    return receiver;
  };
  return check_receivers_sky(
      walker, found,
      {.maximum_distance = sky.maximum_distance, .below = sky.below, .seed = seed, .watch = watch});
}

std::optional<SkyCheck> check_receivers_sky(const ExactWalker& walker,
                                            const std::function<CheckedReceiver(int, int)>& found,
                                            const SkyCheckOptions& options) {
  const bool whole = options.rows == 0;
  const auto width = static_cast<std::uint64_t>(whole ? walker.surface().width() : options.columns);
  const std::uint64_t texels =
      width * static_cast<std::uint64_t>(whole ? walker.surface().height() : options.rows);
  std::vector<Squares> all(kReceivers);
  std::atomic<bool> has_bent{false};
  std::atomic<bool> has_harmonics{false};
  Progress progress("check of the sky", kReceivers, options.watch);
  parallel_for(
      kReceivers,
      [&](std::int64_t i) {
        const std::uint64_t texel = hash_combine(options.seed + 3, static_cast<std::uint64_t>(i)) % texels;
        const int row = options.first_row + static_cast<int>(texel / width);
        const int column = options.first_column + static_cast<int>(texel % width);
        const ExactSky exact = find_exact_sky(walker, row, column, options.maximum_distance, options.below);
        if (std::isnan(exact.sky_view_factor)) return;
        const CheckedReceiver receiver = found(row, column);
        if (receiver.moments.first.size() > 0) has_bent = true;
        if (receiver.moments.second.size() > 0) has_harmonics = true;
        all[static_cast<std::size_t>(i)] = compare(exact, receiver);
      },
      &progress);
  SkyCheck check{0, kSkyCheckAzimuths, 0, 0, {}, {}};
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
  if (has_bent) check.bent_normal_rad = root_mean(sum.bent);
  if (has_harmonics) check.harmonics = root_mean(sum.harmonics);
  return check;
}

}  // namespace heightlight
