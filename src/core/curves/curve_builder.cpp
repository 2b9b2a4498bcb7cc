#include <cassert>
#include <cstdint>
#include <limits>
#include <string>

#include "curves/bin_groups.h"
#include "curves/moments.h"
#include "curves/percentiles.h"
#include "heightlight/curves.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

constexpr int kMostBins = 10000;

/// Of each filled bin.
template <class Vector>
std::vector<BounceStatistics> bin_statistics(const BinGroups& groups, const Vector& irradiance) {
  assert(static_cast<std::size_t>(irradiance.size()) == groups.texel_count());
  const std::vector<Moments> moments = bin_moments(groups, irradiance.data());
  const std::vector<Percentiles> percentiles = bin_percentiles(groups, irradiance.data(), moments);
  std::vector<BounceStatistics> statistics;
  for (std::size_t k = 0; k < moments.size(); ++k) {
    const auto [p05, p50, p95] = percentiles[k];
    statistics.push_back({moments[k].mean(), moments[k].stddev(), p05, p50, p95});
  }
  return statistics;
}

void append_bounce(BounceCurves& curves, const std::vector<BounceStatistics>& of_bins) {
  for (std::size_t k = 0; k < of_bins.size(); ++k) curves.filled[k].bounces.push_back(of_bins[k]);
}

void set_tail(BounceCurves& curves, const std::vector<BounceStatistics>& of_bins) {
  for (std::size_t k = 0; k < of_bins.size(); ++k) curves.filled[k].tail = of_bins[k];
}

}  // namespace

const char* to_string(AoKind kind) {
  return kind == AoKind::ambient_occlusion ? "ambient_occlusion" : "sky_view_factor";
}

CurveBuilder::CurveBuilder(const Map& ao, AoKind kind, int bins) {
  if (bins < 1 || bins > kMostBins) {
    throw UsageError("bins", std::to_string(bins), "must be from 1 to " + std::to_string(kMostBins));
  }
  assert(ao.size() <= std::numeric_limits<std::uint32_t>::max());
  curves_.kind = kind;
  curves_.bins = bins;
  groups_ = std::make_shared<const BinGroups>(ao, bins);
  const std::vector<Moments> of_ao = bin_moments(*groups_, ao.values.data());
  for (std::size_t k = 0; k < of_ao.size(); ++k) {
    CurveBin filled;
    filled.bin = groups_->filled()[k];
    filled.ao_lo = static_cast<double>(filled.bin) / bins;
    filled.ao_hi = static_cast<double>(filled.bin + 1) / bins;
    filled.ao_mean = of_ao[k].mean();
    filled.count = groups_->counts()[k];
    curves_.filled.push_back(filled);
  }
}

void CurveBuilder::add(std::span<const double> irradiance) {
  append_bounce(curves_, bin_statistics(*groups_, irradiance));
}

void CurveBuilder::add(std::span<const float> irradiance) {
  append_bounce(curves_, bin_statistics(*groups_, irradiance));
}

void CurveBuilder::add_tail(std::span<const double> irradiance) {
  set_tail(curves_, bin_statistics(*groups_, irradiance));
}

void CurveBuilder::add_tail(std::span<const float> irradiance) {
  set_tail(curves_, bin_statistics(*groups_, irradiance));
}

}  // namespace heightlight
