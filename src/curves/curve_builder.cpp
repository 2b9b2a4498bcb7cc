#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "heightlight/curves.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

constexpr int kMostBins = 10000;

/// Exact: a float times at most 10000 fits a double. Clamped because an AO summed from floats may pass its
/// range by rounding, and so that 1 falls in the last bin.
std::size_t bin_of(float ao, int bins) {
  const double scaled = std::floor(static_cast<double>(ao) * bins);
  return static_cast<std::size_t>(std::clamp(scaled, 0.0, bins - 1.0));
}

/// Mean, then deviations from it, so that a narrow spread keeps its digits; the second sum takes out what
/// rounding left in the mean.
void set_moments(const std::vector<double>& values, BounceStatistics& out) {
  const double count = static_cast<double>(values.size());
  double sum = 0;
  for (const double value : values) sum += value;
  out.mean = sum / count;
  double squares = 0;
  double rest = 0;
  for (const double value : values) {
    const double deviation = value - out.mean;
    squares += deviation * deviation;
    rest += deviation;
  }
  out.mean += rest / count;
  out.stddev = std::sqrt(std::max(0.0, squares - rest * rest / count) / count);
}

/// The percentile at `share`, whose order statistics [from, until) is known to hold; they are put in their
/// places.
double select_percentile(std::vector<double>& values, double share, std::size_t from, std::size_t until) {
  const double place = share * static_cast<double>(values.size() - 1);
  const double below = std::floor(place);
  const auto at = [&values](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
  const auto lower = at(static_cast<std::size_t>(below));
  std::nth_element(at(from), lower, at(until));
  if (place == below) return *lower;
  const auto upper = lower + 1;
  std::iter_swap(upper, std::min_element(upper, at(until)));
  return *lower + (*upper - *lower) * (place - below);
}

/// The median first: it halves what the other two have to look at.
void set_percentiles(std::vector<double>& values, BounceStatistics& out) {
  const std::size_t count = values.size();
  out.p50 = select_percentile(values, 0.50, 0, count);
  const std::size_t middle = (count - 1) / 2;
  out.p05 = select_percentile(values, 0.05, 0, std::min(middle + 2, count));
  out.p95 = select_percentile(values, 0.95, middle, count);
}

}  // namespace

const char* to_string(AoKind kind) {
  return kind == AoKind::ambient_occlusion ? "ambient_occlusion" : "sky_view_factor";
}

CurveBuilder::CurveBuilder(const Map& ao, AoKind kind, int bins) {
  if (bins < 1 || bins > kMostBins) {
    throw UsageError("the number of bins must lie in 1 to " + std::to_string(kMostBins) + ", not " +
                     std::to_string(bins));
  }
  assert(ao.size() <= std::numeric_limits<std::uint32_t>::max());
  curves_.kind = kind;
  curves_.bins = bins;
  std::vector<std::size_t> counts(static_cast<std::size_t>(bins), 0);
  std::vector<double> sums(counts.size(), 0);
  for (const float value : ao.values) {
    if (std::isnan(value)) continue;
    const std::size_t bin = bin_of(value, bins);
    ++counts[bin];
    sums[bin] += static_cast<double>(value);
  }
  std::vector<std::size_t> place(counts.size(), 0);  // where each bin's next texel goes
  begin_.push_back(0);
  for (std::size_t bin = 0; bin < counts.size(); ++bin) {
    if (counts[bin] == 0) continue;
    CurveBin filled;
    filled.bin = static_cast<int>(bin);
    filled.ao_lo = static_cast<double>(bin) / bins;
    filled.ao_hi = static_cast<double>(bin + 1) / bins;
    filled.ao_mean = sums[bin] / static_cast<double>(counts[bin]);
    filled.count = counts[bin];
    curves_.filled.push_back(filled);
    place[bin] = begin_.back();
    begin_.push_back(begin_.back() + counts[bin]);
  }
  texels_.resize(begin_.back());
  for (std::size_t i = 0; i < ao.size(); ++i) {
    if (!std::isnan(ao.values[i]))
      texels_[place[bin_of(ao.values[i], bins)]++] = static_cast<std::uint32_t>(i);
  }
}

BounceStatistics CurveBuilder::statistics(std::size_t filled, const TexelVector& irradiance) const {
  std::vector<double> values;
  values.reserve(begin_[filled + 1] - begin_[filled]);
  for (std::size_t k = begin_[filled]; k < begin_[filled + 1]; ++k) {
    values.push_back(irradiance[static_cast<Eigen::Index>(texels_[k])]);
  }
  BounceStatistics result;
  set_moments(values, result);
  set_percentiles(values, result);
  return result;
}

void CurveBuilder::add(const TexelVector& irradiance) {
  const auto count = static_cast<std::int64_t>(curves_.filled.size());
  // From the most open bins, as a rule the fullest, so that no thread is left alone with them at the end.
  parallel_for(count, [&](std::int64_t i) {
    const auto filled = static_cast<std::size_t>(count - 1 - i);
    curves_.filled[filled].bounces.push_back(statistics(filled, irradiance));
  });
}

void CurveBuilder::add_tail(const TexelVector& irradiance) {
  const auto count = static_cast<std::int64_t>(curves_.filled.size());
  parallel_for(count, [&](std::int64_t i) {
    const auto filled = static_cast<std::size_t>(count - 1 - i);
    curves_.filled[filled].tail = statistics(filled, irradiance);
  });
}

}  // namespace heightlight
