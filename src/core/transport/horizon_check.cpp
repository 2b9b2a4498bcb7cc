#include <algorithm>
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
constexpr int kAzimuths = 256;

/// What one receiver finds wrong.
struct ReceiverError {
  double sky = 0;
  std::vector<double> total = {};  ///< per total
  std::vector<double> gain = {};   ///< 1/(1 − ρ (1 − A))
};

/// The i-th of `count` texels, one from each of as many equal parts of a map of `texels`.
std::size_t pick_texel(std::int64_t i, std::int64_t count, std::int64_t texels, std::uint64_t seed) {
  const std::int64_t begin = texels * i / count;
  const std::int64_t end = texels * (i + 1) / count;
  const std::uint64_t pick = hash_combine(seed + 2, static_cast<std::uint64_t>(i));
  return static_cast<std::size_t>(begin) + pick % static_cast<std::uint64_t>(end - begin);
}

ReceiverError find_error(const Surface& surface, const SliceView& view, std::size_t texel, double sky,
                         const std::vector<CheckedTotal>& totals) {
  ReceiverError error{.sky = sky - view.sky_view_factor};
  for (const CheckedTotal& checked : totals) {
    const auto albedo = [&checked](std::size_t i) {
      return checked.varying ? (*checked.varying)[i] : checked.albedo;
    };
    const auto radiosity = [&](std::size_t i) { return albedo(i) * checked.total[i]; };
    const double direct = checked.direct ? (*checked.direct)[texel] : view.sky_view_factor;
    error.total.push_back(checked.total[texel] - direct - gather_exactly(view, surface, radiosity));
    error.gain.push_back(1 / std::max(1e-3, 1 - albedo(texel) * (1 - view.sky_view_factor)));
  }
  return error;
}

/// Of the total with index `t`.
HorizonCheck sum_up(const std::vector<ReceiverError>& errors, std::size_t t) {
  HorizonCheck check{.receivers = static_cast<int>(errors.size()), .azimuths = kAzimuths};
  if (errors.empty()) return check;
  double sky_squares = 0;
  double squares = 0;
  double sum = 0;
  double gain = 0;
  for (const ReceiverError& error : errors) {
    sky_squares += error.sky * error.sky;
    squares += error.total[t] * error.total[t];
    sum += error.total[t];
    gain += error.gain[t];
  }
  const double mean = sum / check.receivers;
  const double spread = std::max(0.0, squares / check.receivers - mean * mean);
  check.sky_rmse = std::sqrt(sky_squares / check.receivers);
  check.total_rmse = std::hypot(std::sqrt(spread), mean * gain / check.receivers);
  return check;
}

}  // namespace

std::vector<HorizonCheck> check_by_exact_walks(const Surface& surface, const TexelVector& sky,
                                               const std::vector<CheckedTotal>& totals, std::uint64_t seed,
                                               const Watch& watch) {
  const ExactWalker walker(surface, kAzimuths);
  const auto texels = static_cast<std::int64_t>(surface.map.height.size());
  const std::int64_t count = std::min(kReceivers, texels);
  std::vector<std::optional<ReceiverError>> found(static_cast<std::size_t>(count));
  Progress progress("check of the total", count, watch);
  parallel_for(
      count,
      [&](std::int64_t i) {
        const std::size_t texel = pick_texel(i, count, texels, seed);
        const auto width = static_cast<std::size_t>(surface.width());
        SliceView view;
        walker.view(static_cast<int>(texel / width), static_cast<int>(texel % width), view);
        if (std::isnan(view.sky_view_factor)) return;
        found[static_cast<std::size_t>(i)] = find_error(surface, view, texel, sky[texel], totals);
      },
      &progress);
  std::vector<ReceiverError> errors;
  for (std::optional<ReceiverError>& error : found) {
    if (error) errors.push_back(std::move(*error));
  }
  std::vector<HorizonCheck> checks;
  for (std::size_t t = 0; t < totals.size(); ++t) checks.push_back(sum_up(errors, t));
  return checks;
}

}  // namespace heightlight
