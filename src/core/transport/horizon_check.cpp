#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "base/hash.h"
#include "base/parallel.h"
#include "heightlight/transport.h"
#include "transport/exact_gather.h"

namespace heightlight {
namespace {

constexpr std::int64_t kReceivers = 256;
constexpr int kMostRounds = 3;
constexpr int kAzimuths = 128;  // leave .0001 of A and .0003 of a gather on bricks

/// A figure whose standard error is less than this share of it is good enough.
constexpr double kGoodEnough = 0.1;

/// Classes of receivers by A, about as many in each.
constexpr std::size_t kClasses = 16;
using PerClass = std::array<double, kClasses>;

/// What one receiver finds wrong with one total, and Σ F ρ over the places that it sees, by their class.
struct TotalError {
  double residual = 0;
  PerClass seen{};
};

struct ReceiverError {
  std::size_t own_class = 0;
  double ambient = 0;
  double sky = 0;
  std::vector<TotalError> totals = {};
};

/// The i-th of `count` texels, one from each of as many equal parts of a map of `texels`.
std::size_t pick_texel(std::int64_t i, std::int64_t count, std::int64_t texels, std::uint64_t seed) {
  const std::int64_t begin = texels * i / count;
  const std::int64_t end = texels * (i + 1) / count;
  const std::uint64_t pick = hash_combine(seed, static_cast<std::uint64_t>(i));
  return static_cast<std::size_t>(begin) + pick % static_cast<std::uint64_t>(end - begin);
}

/// Bounds between classes: quantiles of A over a sample of the map.
class SkyClasses {
 public:
  SkyClasses(const Surface& surface, const TexelVector& sky, std::uint64_t seed) {
    constexpr std::int64_t kSample = 4096;
    const auto texels = static_cast<std::int64_t>(sky.size());
    std::vector<double> sample;
    for (std::int64_t i = 0; i < std::min(kSample, texels); ++i) {
      const std::size_t texel = pick_texel(i, std::min(kSample, texels), texels, seed + 5);
      if (!std::isnan(surface.map.height.values[texel])) sample.push_back(sky[texel]);
    }
    std::sort(sample.begin(), sample.end());
    for (std::size_t k = 0; k + 1 < kClasses && !sample.empty(); ++k)
      bounds_.push_back(sample[(k + 1) * sample.size() / kClasses]);
  }

  std::size_t of(double sky) const {
    return static_cast<std::size_t>(std::upper_bound(bounds_.begin(), bounds_.end(), sky) - bounds_.begin());
  }

 private:
  std::vector<double> bounds_;
};

/// What is checked, and what all its receivers share.
struct Check {
  const Surface& surface;
  const TexelVector& sky;
  const std::vector<CheckedTotal>& totals;
  const Map* ambient;
  SkyClasses classes;
};

/// The texel next to a place.
std::size_t nearest_texel(const SurfacePoint& place, const Surface& surface) {
  const auto width = static_cast<std::uint32_t>(surface.width());
  const int row = static_cast<int>(place.cell / width) + (place.down > 0.5F ? 1 : 0);
  const int column = static_cast<int>(place.cell % width) + (place.across > 0.5F ? 1 : 0);
  return surface.map.height.index(row % surface.height(), column % surface.width());
}

ReceiverError find_error(const Check& check, const SliceView& view, std::size_t texel) {
  ReceiverError error{.own_class = check.classes.of(check.sky[texel])};
  error.sky = check.sky[texel] - view.sky_view_factor;
  if (check.ambient) error.ambient = double{check.ambient->values[texel]} - view.ambient_occlusion;
  for (const CheckedTotal& checked : check.totals) {
    const auto albedo = [&checked](std::size_t i) {
      return checked.varying ? (*checked.varying)[i] : checked.albedo;
    };
    const auto radiosity = [&](std::size_t i) { return albedo(i) * checked.total[i]; };
    const double direct = checked.direct ? (*checked.direct)[texel] : view.sky_view_factor;
    TotalError& total = error.totals.emplace_back();
    total.residual = checked.total[texel] - direct - gather_exactly(view, check.surface, radiosity);
    for (const VisibleInterval& link : view.links) {
      const std::size_t seen = nearest_texel(link.place, check.surface);
      total.seen[check.classes.of(check.sky[seen])] += link.weight * albedo(seen);
    }
  }
  return error;
}

/// Means of e over the receivers of each class: those of r, and of what the classes' means bring by way of F
/// ρ. A Jacobi iteration converges since F ρ takes less than it finds; slowly where nearly nothing is lost.
PerClass solve_classes(const std::vector<ReceiverError>& errors, std::size_t t) {
  constexpr int kIterations = 200;
  PerClass count{};
  PerClass residual{};
  std::array<PerClass, kClasses> seen{};
  for (const ReceiverError& error : errors) {
    count[error.own_class] += 1;
    residual[error.own_class] += error.totals[t].residual;
    for (std::size_t k = 0; k < kClasses; ++k) seen[error.own_class][k] += error.totals[t].seen[k];
  }
  PerClass mean{};
  for (int i = 0; i < kIterations; ++i) {
    PerClass next{};
    for (std::size_t c = 0; c < kClasses; ++c) {
      if (count[c] == 0) continue;
      double sum = residual[c];
      for (std::size_t k = 0; k < kClasses; ++k) sum += seen[c][k] * mean[k];
      next[c] = sum / count[c];
    }
    mean = next;
  }
  return mean;
}

/// Of the total with index `t`.
HorizonCheck sum_up(const std::vector<ReceiverError>& errors, std::size_t t) {
  HorizonCheck check{.receivers = static_cast<int>(errors.size()), .azimuths = kAzimuths};
  if (errors.empty()) return check;
  const PerClass mean = solve_classes(errors, t);
  double ambient = 0;
  double sky = 0;
  double squares = 0;
  double fourths = 0;
  for (const ReceiverError& error : errors) {
    double own = error.totals[t].residual;
    for (std::size_t k = 0; k < kClasses; ++k) own += error.totals[t].seen[k] * mean[k];
    ambient += error.ambient * error.ambient;
    sky += error.sky * error.sky;
    squares += own * own;
    fourths += own * own * own * own;
  }
  const double count = check.receivers;
  check.ambient_rmse = std::sqrt(ambient / count);
  check.sky_rmse = std::sqrt(sky / count);
  check.total_rmse = std::sqrt(squares / count);
  const double spread = std::max(0.0, fourths / count - squares * squares / (count * count));
  if (squares > 0) check.total_standard_error = std::sqrt(spread / count) / (2 * check.total_rmse);
  return check;
}

/// Walks from `count` more receivers.
void add_receivers(const Check& check, const ExactWalker& walker, std::uint64_t seed, const Watch& watch,
                   std::vector<ReceiverError>& errors) {
  const auto texels = static_cast<std::int64_t>(check.sky.size());
  const std::int64_t count = std::min(kReceivers, texels);
  std::vector<std::optional<ReceiverError>> found(static_cast<std::size_t>(count));
  Progress progress("check of the total", count, watch);
  parallel_for(
      count,
      [&](std::int64_t i) {
        const std::size_t texel = pick_texel(i, count, texels, seed);
        const auto width = static_cast<std::size_t>(check.surface.width());
        SliceView view;
        walker.view(static_cast<int>(texel / width), static_cast<int>(texel % width), view);
        if (std::isnan(view.sky_view_factor)) return;
        found[static_cast<std::size_t>(i)] = find_error(check, view, texel);
      },
      &progress);
  for (std::optional<ReceiverError>& error : found) {
    if (error) errors.push_back(std::move(*error));
  }
}

}  // namespace

std::vector<HorizonCheck> check_by_exact_walks(const Surface& surface, const TexelVector& sky,
                                               const std::vector<CheckedTotal>& totals, std::uint64_t seed,
                                               const Watch& watch, const Map* ambient_occlusion) {
  const ExactWalker walker(surface, kAzimuths);
  const Check check{.surface = surface,
                    .sky = sky,
                    .totals = totals,
                    .ambient = ambient_occlusion,
                    .classes = {surface, sky, seed}};
  std::vector<ReceiverError> errors;
  std::vector<HorizonCheck> checks(totals.size());
  std::vector<bool> good(totals.size());  // a figure stays that is good enough, whatever the others want
  for (int round = 0; round < kMostRounds; ++round) {
    add_receivers(check, walker, hash_combine(seed + 2, static_cast<std::uint64_t>(round)), watch, errors);
    for (std::size_t t = 0; t < totals.size(); ++t) {
      if (good[t]) continue;
      checks[t] = sum_up(errors, t);
      good[t] = checks[t].total_standard_error <= kGoodEnough * checks[t].total_rmse;
    }
    const bool all_good = std::find(good.begin(), good.end(), false) == good.end();
    if (all_good || errors.empty() || sky.size() <= kReceivers) break;
  }
  return checks;
}

}  // namespace heightlight
