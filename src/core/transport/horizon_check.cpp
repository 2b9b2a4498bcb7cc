#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/hash.h"
#include "base/parallel.h"
#include "heightlight/transport.h"
#include "transport/error_propagation.h"
#include "visibility/exact_sky.h"

namespace heightlight {
namespace {

constexpr std::int64_t kReceivers = 256;
constexpr int kMostRounds = 3;

/// Azimuths that leave little beside the error wanted: on bricks 128 leave .0001 of A and .0003 of a gather,
/// 64 twice that and more.
int azimuths_for_check(double error_wanted) { return error_wanted < 0.004 ? 128 : 64; }

/// How much what is seen errs like who sees it: with this, what is said of bricks, cobbles and fractal ground
/// is mostly within a fifth of what is true (plots/promise.md). Without, it was a fifth to a half too little.
constexpr double kAlike = 0.5;

/// A figure whose standard error is less than this share of it is good enough; so is one that twice its
/// standard error does not take beyond this share of the error wanted.
constexpr double kGoodEnough = 0.1;
constexpr double kClearlyMet = 0.9;

struct ReceiverError {
  double ambient = 0;
  double sky = 0;
  std::vector<FoundError> totals = {};  ///< each by itself
};

/// What is checked, and what all its receivers share.
struct Check {
  const ExactWalker& walker;
  const TexelVector& sky;
  const std::vector<CheckedTotal>& totals;
  const Map* ambient;
  bool above_horizontal;
  SkyClasses classes;
};

/// E₀/π of a total at a receiver.
double direct_light(const Check& check, const CheckedTotal& checked, const SliceView& view,
                    std::size_t texel) {
  if (!checked.direct) return view.sky_view_factor;
  if (!check.above_horizontal) return (*checked.direct)[texel];
  const auto width = static_cast<std::size_t>(check.walker.surface().width());
  return sky_above_horizontal(check.walker, static_cast<int>(texel / width), static_cast<int>(texel % width),
                              view);
}

ReceiverError find_error(const Check& check, const SliceView& view, std::size_t texel) {
  const Surface& surface = check.walker.surface();
  ReceiverError error{.sky = check.sky[texel] - view.sky_view_factor};
  if (check.ambient) error.ambient = double{check.ambient->values[texel]} - view.ambient_occlusion;
  const auto sky = [&check](std::size_t i) { return check.sky[i]; };
  for (const CheckedTotal& checked : check.totals) {
    const auto albedo = [&checked](std::size_t i) {
      return checked.varying ? (*checked.varying)[i] : checked.albedo;
    };
    const auto radiosity = [&](std::size_t i) { return albedo(i) * checked.total[i]; };
    const double gathered = gather_exactly(view, surface, radiosity);
    const double direct = direct_light(check, checked, view, texel);
    error.totals.push_back({.residual = checked.total[texel] - direct - gathered,
                            .own_class = check.classes.of(check.sky[texel]),
                            .seen = seen_by_class(view, surface, check.classes, albedo, sky)});
  }
  return error;
}

/// Of the total with index `t`.
HorizonCheck sum_up(const std::vector<ReceiverError>& errors, std::size_t t, int azimuths) {
  HorizonCheck check{.receivers = static_cast<int>(errors.size()), .azimuths = azimuths};
  if (errors.empty()) return check;
  std::vector<FoundError> found;
  double ambient = 0;
  double sky = 0;
  for (const ReceiverError& error : errors) {
    found.push_back(error.totals[t]);
    ambient += error.ambient * error.ambient;
    sky += error.sky * error.sky;
  }
  double squares = 0;
  double fourths = 0;
  for (const double error : propagate_errors(found, kAlike)) {
    squares += error * error;
    fourths += error * error * error * error;
  }
  const double count = check.receivers;
  check.ambient_rmse = std::sqrt(ambient / count);
  check.sky_rmse = std::sqrt(sky / count);
  check.total_rmse = std::sqrt(squares / count);
  const double spread = std::max(0.0, fourths / count - squares * squares / (count * count));
  if (squares > 0) check.total_standard_error = std::sqrt(spread / count) / (2 * check.total_rmse);
  return check;
}

bool is_good_enough(const HorizonCheck& check, double error_wanted) {
  return check.total_standard_error <= kGoodEnough * check.total_rmse ||
         check.total_rmse + 2 * check.total_standard_error <= kClearlyMet * error_wanted;
}

/// Walks from `count` more receivers.
void add_receivers(const Check& check, std::uint64_t seed, const Watch& watch,
                   std::vector<ReceiverError>& errors) {
  const auto texels = static_cast<std::int64_t>(check.sky.size());
  const std::int64_t count = std::min(kReceivers, texels);
  std::vector<std::optional<ReceiverError>> found(static_cast<std::size_t>(count));
  Progress progress("check of the total", count, watch);
  parallel_for(
      count,
      [&](std::int64_t i) {
        const std::size_t texel = pick_texel(i, count, texels, seed);
        const auto width = static_cast<std::size_t>(check.walker.surface().width());
        SliceView view;
        check.walker.view(static_cast<int>(texel / width), static_cast<int>(texel % width), view);
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
                                               const std::vector<CheckedTotal>& totals,
                                               const CheckOptions& options) {
  const ExactWalker walker(surface, azimuths_for_check(options.error));
  const Check check{.walker = walker,
                    .sky = sky,
                    .totals = totals,
                    .ambient = options.ambient_occlusion,
                    .above_horizontal = options.above_horizontal,
                    .classes = {surface, sky, options.seed + 5}};
  std::vector<ReceiverError> errors;
  std::vector<HorizonCheck> checks(totals.size());
  std::vector<bool> good(totals.size());  // a figure stays that is good enough, whatever the others want
  for (int round = 0; round < kMostRounds; ++round) {
    const std::uint64_t seed = hash_combine(options.seed + 2, static_cast<std::uint64_t>(round));
    add_receivers(check, seed, options.watch, errors);
    for (std::size_t t = 0; t < totals.size(); ++t) {
      if (good[t]) continue;
      checks[t] = sum_up(errors, t, walker.azimuths());
      good[t] = is_good_enough(checks[t], options.error);
    }
    const bool all_good = std::find(good.begin(), good.end(), false) == good.end();
    if (all_good || errors.empty() || sky.size() <= kReceivers) break;
  }
  return checks;
}

}  // namespace heightlight
