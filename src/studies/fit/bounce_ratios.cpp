#include "fit/bounce_ratios.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "heightlight/forms.h"

namespace heightlight {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kFaintest = 1e-4;  // E/π below which a ratio is one of errors
constexpr std::size_t kSpreadBounces = 10;
constexpr double kFewestShare = 1e-3;  // of the texels, in a bin

RatioBin make_bin(const CurveBin& bin) {
  RatioBin ratios{.ao = bin.ao_mean, .count = bin.count, .ratios = {}};
  bool is_faint = false;
  for (std::size_t b = 1; b + 1 < bin.bounces.size(); ++b) {
    is_faint = is_faint || bin.bounces[b].mean < kFaintest;
    ratios.ratios.push_back(is_faint ? kNone : bin.bounces[b + 1].mean / bin.bounces[b].mean);
  }
  const double missing = 1 - bin.bounces[0].mean;
  ratios.by_conservation = missing > 0 ? 1 - bin.bounces[1].mean / missing : kNone;
  ratios.published = notes_ratio(AmbientOcclusion(bin.ao_mean));
  return ratios;
}

/// Greatest less least of the first ten ratios; 0 of fewer than two.
double spread_of(const RatioBin& bin) {
  double least = std::numeric_limits<double>::infinity();
  double greatest = -least;
  for (std::size_t i = 0; i < std::min(bin.ratios.size(), kSpreadBounces); ++i) {
    if (std::isnan(bin.ratios[i])) break;
    least = std::min(least, bin.ratios[i]);
    greatest = std::max(greatest, bin.ratios[i]);
  }
  return std::max(0.0, greatest - least);
}

}  // namespace

BounceRatios find_bounce_ratios(const std::string& map, const BounceCurves& over_alpha) {
  BounceRatios found{.map = map, .bins = {}};
  double texels = 0;
  for (const CurveBin& bin : over_alpha.filled) texels += static_cast<double>(bin.count);
  double weights = 0;
  for (const CurveBin& bin : over_alpha.filled) {
    if (static_cast<double>(bin.count) < kFewestShare * texels || bin.bounces.size() < 2) continue;
    found.bins.push_back(make_bin(bin));
    const double weight = static_cast<double>(bin.count) * std::max(0.0, 1 - bin.bounces[0].mean);
    found.spread += weight * spread_of(found.bins.back());
    weights += weight;
  }
  if (weights > 0) found.spread /= weights;
  return found;
}

const RatioBin* find_bin(const BounceRatios& ratios, double alpha) {
  constexpr double kNear = 0.05;
  const RatioBin* nearest = nullptr;
  for (const RatioBin& bin : ratios.bins) {
    const double distance = std::abs(bin.ao - alpha);
    if (distance < kNear && (!nearest || distance < std::abs(nearest->ao - alpha))) nearest = &bin;
  }
  return nearest;
}

}  // namespace heightlight
