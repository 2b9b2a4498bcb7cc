#include <algorithm>
#include <cmath>
#include <limits>

#include "base/area_mean.h"
#include "base/progress.h"
#include "heightlight/solve.h"
#include "relief/match_judgement.h"
#include "relief/match_relief.h"

namespace heightlight {
namespace {

/// A and what it is to be like, at one relief.
struct OcclusionFit {
  double rmse = std::numeric_limits<double>::infinity();
  double correlation = 0;
};

/// Of what lies at least `margin` texels inside.
OcclusionFit compare(const Map& ours, const Map& theirs, int margin) {
  double n = 0;
  double a = 0;
  double b = 0;
  double aa = 0;
  double bb = 0;
  double ab = 0;
  for (int row = margin; row < ours.height - margin; ++row) {
    for (int column = margin; column < ours.width - margin; ++column) {
      const double x = double{ours(row, column)};
      const double y = double{theirs(row, column)};
      if (std::isnan(x) || std::isnan(y)) continue;
      n += 1;
      a += x;
      b += y;
      aa += x * x;
      bb += y * y;
      ab += x * y;
    }
  }
  const double spread = (aa - a * a / n) * (bb - b * b / n);
  return {.rmse = std::sqrt(std::max(0.0, aa - 2 * ab + bb) / n),
          .correlation = spread > 0 ? (ab - a * b / n) / std::sqrt(spread) : 0};
}

/// How the walk at one relief is asked for.
Request occlusion_request(const Watch& watch) {
  Request request;
  request.wanted.sky = true;
  request.accuracy.plan = HorizonPlan{.sky = {.walk = {.azimuths = 16, .samples_per_octave = 8}}};
  request.checks = {.sky = false, .totals = false, .energy = false, .bounces = false};
  request.watch = {.tell = {}, .stopped = watch.stopped};
  return request;
}

/// The map with its heights times a factor, and A of it.
Map occlusion_at(Heightmap map, double factor, const Watch& watch) {
  for (float& height : map.height.values) height = static_cast<float>(double{height} * factor);
  map.curvature *= factor;
  return solve(build_surface(std::move(map)), occlusion_request(watch)).sky_view_factor;
}

/// The middle of a map, at most so many texels a side.
Map middle_of(const Map& map, int largest_side) {
  Map part(std::min(map.width, largest_side), std::min(map.height, largest_side));
  const int top = (map.height - part.height) / 2;
  const int left = (map.width - part.width) / 2;
  for (int row = 0; row < part.height; ++row) std::copy_n(&map(top + row, left), part.width, &part(row, 0));
  return part;
}

/// Where between two places f is least, by a golden section of so many evaluations, of a function that
/// falls and then rises.
template <class Function>
double least_between(double low, double high, int evaluations, const Function& f) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double left = high - golden * (high - low);
  double right = low + golden * (high - low);
  double at_left = f(left);
  double at_right = f(right);
  for (int i = 2; i < evaluations; ++i) {
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - golden * (high - low);
      at_left = f(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + golden * (high - low);
      at_right = f(right);
    }
  }
  return (low + high) / 2;
}

/// The octave, at most `highest`, at which f is least, walking downhill from `first`.
template <class Function>
int least_octave(int first, int lowest, int highest, const Function& f) {
  int best = first;
  double least = f(first);
  for (const int step : {-1, 1}) {
    for (int octave = best + step; octave >= lowest && octave <= highest; octave += step) {
      const double found = f(octave);
      if (!(found < least)) break;
      least = found;
      best = octave;
    }
    if (best != first) break;  // downhill was this way
  }
  return best;
}

}  // namespace

ReliefMatch match_occlusion(const Heightmap& map, const Map& occlusion, const Watch& watch) {
  refuse_level_match(map);
  const Image<float>& heights = map.height;
  const Map theirs = middle_of(area_mean(occlusion, heights.width, heights.height), kMatchSide);
  Heightmap part = map;
  part.height = middle_of(heights, kMatchSide);
  const bool is_cut = part.height.size() < heights.size();
  if (is_cut) part.boundary = Boundary::open;
  const int margin = is_cut ? std::min(part.height.width, part.height.height) / 8 : 0;
  const double extent = map.spacing.x * heights.width;
  const double per_width = extent / relief(map);
  constexpr int kLowest = -10;  // octaves of relief, below the width
  constexpr int kFirst = -5;
  constexpr int kSteps = 9;  // over two octaves: to 2 %
  Progress progress("match", 0, watch);
  const auto fit_at = [&](double octaves) {
    progress.throw_if_stopped();
    const OcclusionFit fit =
        compare(occlusion_at(part, std::exp2(octaves) * per_width, watch), theirs, margin);
    progress.add(1);
    return fit;
  };
  const auto rmse_at = [&](double octaves) { return fit_at(octaves).rmse; };
  const int octave = least_octave(kFirst, kLowest, 0, rmse_at);
  const double found = least_between(std::max(octave - 1, kLowest), std::min(octave + 1, 0), kSteps, rmse_at);
  const OcclusionFit fit = fit_at(found);
  ReliefMatch match{
      .relief = std::exp2(found) * extent, .residual = fit.rmse, .correlation = fit.correlation};
  if (octave == 0 || octave == kLowest) {
    match.doubt = "the best relief lies at the end of those that were tried";
  } else if (fit.correlation < kPoorMatch) {
    match.doubt = "the occlusion is not that of these heights at any relief";
  }
  return match;
}

std::uint64_t match_bytes(int width, int height) {
  constexpr std::uint64_t kSlopes = 3 * sizeof(float);
  constexpr std::uint64_t kCopies = 4 * sizeof(float);  // of heights and occlusion
  constexpr std::uint64_t kOfNormals = sizeof(float) + sizeof(Vector3) + 4 * kSlopes;
  const std::uint64_t texels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  const std::uint64_t walking =
      estimate_memory(std::min(width, kMatchSide), std::min(height, kMatchSide), occlusion_request({}));
  return std::max(kOfNormals * texels, kCopies * texels + walking);
}

}  // namespace heightlight
