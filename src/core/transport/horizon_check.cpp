#include "transport/horizon_check.h"

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

constexpr std::int64_t kReceivers = 512;
constexpr int kMostRounds = 4;

/// An RMSE whose standard error is at most kGoodEnough of it is good enough, unless twice the standard error
/// leaves open whether the error wanted was missed. It is also good enough if the RMSE and twice its standard
/// error together are at most kClearlyMet of the error wanted.
constexpr double kGoodEnough = 0.1;
constexpr double kClearlyMet = 0.9;

std::int64_t texels_of(const ExactWalker& walker) {
  return std::int64_t{walker.surface().width()} * walker.surface().height();
}

struct ReceiverError {
  double ambient = 0;
  double sky = 0;
  std::vector<FoundError> totals = {};  ///< one per total
};

/// What all receivers of a check share.
struct Check {
  const ExactWalker& walker;
  const FoundMaps& found;
  bool above_horizontal;
  SkyClasses classes;
};

/// E₀/π of a total at a receiver.
double direct_irradiance(const Check& check, const FoundTotal& checked, const SliceView& view,
                         std::size_t texel) {
  if (!checked.direct) return view.sky_view_factor;
  if (!check.above_horizontal) return checked.direct(texel);
  const auto width = static_cast<std::size_t>(check.walker.surface().width());
  return sky_above_horizontal(check.walker, static_cast<int>(texel / width), static_cast<int>(texel % width),
                              view);
}

/// r of a total at a receiver.
double find_residual(const Check& check, const FoundTotal& checked, const SliceView& view,
                     std::size_t texel) {
  const auto radiosity = [&](std::size_t i) { return checked.albedo(i) * checked.total(i); };
  const double gathered = gather_exactly(view, check.walker.surface(), radiosity);
  return checked.total(texel) - direct_irradiance(check, checked, view, texel) - gathered;
}

/// The exact view from a texel.
SliceView view_from(const Check& check, std::size_t texel) {
  const auto width = static_cast<std::size_t>(check.walker.surface().width());
  SliceView view;
  check.walker.view(static_cast<int>(texel / width), static_cast<int>(texel % width), view);
  return view;
}

/// A texel that the view shows, picked by its form factor. Receivers that see little mostly pick none.
std::optional<std::size_t> pick_seen(const Check& check, const SliceView& view, std::uint64_t hash) {
  const double share = 1 - view.sky_view_factor;
  if (unit_real(hash) > share * share) return std::nullopt;
  double left = unit_real(scramble(hash)) * share;
  for (const VisibleInterval& link : view.links) {
    left -= link.weight;
    if (left <= 0) return nearest_texel(link.place, check.walker.surface());
  }
  return std::nullopt;
}

ReceiverError find_error(const Check& check, const SliceView& view, std::size_t texel, std::uint64_t hash) {
  const Surface& surface = check.walker.surface();
  const FoundMaps& found = check.found;
  const double share = found.sky(texel);
  ReceiverError error{.sky = share - view.sky_view_factor};
  if (found.ambient) error.ambient = found.ambient(texel) - view.ambient_occlusion;
  for (const FoundTotal& checked : found.totals) {
    error.totals.push_back({.residual = find_residual(check, checked, view, texel),
                            .own_class = check.classes.of(share),
                            .seen = seen_by_class(view, surface, check.classes, checked.albedo, found.sky)});
  }
  const std::optional<std::size_t> seen = pick_seen(check, view, hash);
  if (!seen) return error;
  const SliceView view_there = view_from(check, *seen);
  if (std::isnan(view_there.sky_view_factor)) return error;
  for (std::size_t t = 0; t < found.totals.size(); ++t) {
    error.totals[t].place = {.residual = find_residual(check, found.totals[t], view_there, *seen),
                             .own_class = check.classes.of(found.sky(*seen))};
  }
  return error;
}

/// The check of the total with index `t`.
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
  for (const double error : propagate_errors(found)) {
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
  const double either_way = 2 * check.total_standard_error;
  const bool open = std::abs(check.total_rmse - kMissed * error_wanted) < either_way;
  return (check.total_standard_error <= kGoodEnough * check.total_rmse && !open) ||
         check.total_rmse + either_way <= kClearlyMet * error_wanted;
}

/// Adds the errors of further receivers, found by exact walks.
void add_receivers(const Check& check, std::uint64_t seed, const Watch& watch,
                   std::vector<ReceiverError>& errors) {
  const std::int64_t texels = texels_of(check.walker);
  const std::int64_t count = std::min(kReceivers, texels);
  std::vector<std::optional<ReceiverError>> found(static_cast<std::size_t>(count));
  Progress progress("check of the total", count, watch);
  parallel_for(
      count,
      [&](std::int64_t i) {
        const std::size_t texel = pick_texel(i, count, texels, seed);
        const SliceView view = view_from(check, texel);
        if (std::isnan(view.sky_view_factor)) return;
        const std::uint64_t hash = hash_combine(seed + 1, static_cast<std::uint64_t>(i));
        found[static_cast<std::size_t>(i)] = find_error(check, view, texel, hash);
      },
      &progress);
  for (std::optional<ReceiverError>& error : found) {
    if (error) errors.push_back(std::move(*error));
  }
}

}  // namespace

int azimuths_for_check(double error_wanted) { return error_wanted < 0.004 ? 128 : 64; }

std::vector<HorizonCheck> check_found(const ExactWalker& walker, const FoundMaps& found,
                                      std::vector<double> class_sample, const CheckOptions& options) {
  const Check check{.walker = walker,
                    .found = found,
                    .above_horizontal = options.above_horizontal,
                    .classes = SkyClasses(std::move(class_sample))};
  std::vector<ReceiverError> errors;
  std::vector<HorizonCheck> checks(found.totals.size());
  std::vector<bool> good(
      found.totals.size());  // a figure that is good enough stays as it is while others are refined
  for (int round = 0; round < kMostRounds; ++round) {
    const std::uint64_t seed = hash_combine(options.seed + 2, static_cast<std::uint64_t>(round));
    add_receivers(check, seed, options.watch, errors);
    for (std::size_t t = 0; t < found.totals.size(); ++t) {
      if (good[t]) continue;
      checks[t] = sum_up(errors, t, walker.azimuths());
      good[t] = is_good_enough(checks[t], options.error);
    }
    const bool all_good = std::find(good.begin(), good.end(), false) == good.end();
    if (all_good || errors.empty() || texels_of(walker) <= kReceivers) break;
  }
  return checks;
}

std::vector<HorizonCheck> check_by_exact_walks(const Surface& surface, const TexelVector& sky,
                                               const std::vector<CheckedTotal>& totals,
                                               const CheckOptions& options) {
  const ExactWalker walker(surface, azimuths_for_check(options.error));
  FoundMaps found{.sky = [&sky](std::size_t i) { return sky[i]; }};
  if (options.ambient_occlusion) {
    const Map& ambient = *options.ambient_occlusion;
    found.ambient = [&ambient](std::size_t i) { return double{ambient.values[i]}; };
  }
  for (const CheckedTotal& checked : totals) {
    FoundTotal& total = found.totals.emplace_back();
    total.total = [&checked](std::size_t i) { return checked.total[i]; };
    total.albedo = [&checked](std::size_t i) {
      return checked.varying ? (*checked.varying)[i] : checked.albedo;
    };
    if (checked.direct) total.direct = [&checked](std::size_t i) { return (*checked.direct)[i]; };
  }
  std::vector<double> sample;
  for (const std::size_t texel : SkyClasses::sample_receivers(surface, options.seed + 5))
    sample.push_back(sky[texel]);
  return check_found(walker, found, std::move(sample), options);
}

}  // namespace heightlight
