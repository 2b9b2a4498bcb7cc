#include "fit/bounce_fits.h"

#include <algorithm>
#include <cmath>

#include "base/progress.h"
#include "fit/bootstrap.h"
#include "fit/fit_points.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

/// C of the notes' F₁ (eq. 11).
constexpr double kPublishedExponent = 0.25;

/// A and B slide along a valley that few texels leave open: where A passes this they have.
constexpr double kLargestGain = 1e9;

std::array<double, 3> to_constants(const Eigen::VectorXd& parameters) {
  return {std::exp(parameters[0]), parameters[1], parameters[2]};
}

double highest_mean(const std::vector<FitPoint>& points) {
  double highest = 0;
  for (const FitPoint& point : points) highest = std::max(highest, point.measured[0]);
  return highest;
}

std::size_t fewest_bounces(const std::vector<JudgedMap>& maps) {
  std::size_t fewest = maps.front().over_alpha.filled.front().bounces.size() - 1;
  for (const JudgedMap& map : maps)
    fewest = std::min(fewest, map.over_alpha.filled.front().bounces.size() - 1);
  return fewest;
}

}  // namespace

double evaluate_bounce(const std::array<double, 3>& constants, double alpha) {
  const double rest = 1 - alpha;
  return constants[0] * alpha * rest * std::sqrt(rest) *
         std::exp(-constants[1] * std::pow(alpha, constants[2]));
}

FormFamily make_bounce_family(std::size_t bounce, const std::array<double, 3>& start) {
  FormFamily family{.name = "bounce_" + std::to_string(bounce),
                    .formula = "A alpha (1 - alpha)^1.5 exp(-B alpha^C)",
                    .source = "Patapom, summing the curves",
                    .kind = AoKind::ambient_occlusion,
                    .target = FitTarget::one_bounce,
                    .bounce = bounce,
                    .parameters = {"ln A", "B", "C"},
                    .published = {std::log(start[0]), start[1], start[2]}};
  family.evaluate = [](const Eigen::VectorXd& p, const ModelInputs& in, double) {
    return evaluate_bounce(to_constants(p), clamp_share(in.ambient_occlusion.value));
  };
  return family;
}

std::vector<BounceFit> fit_bounces(const std::vector<JudgedMap>& maps, int draws, std::uint64_t seed,
                                   const Watch& watch) {
  const NotesConstants notes;
  std::array<double, 3> start{notes.first_gain, notes.first_decay, kPublishedExponent};
  std::vector<BounceFit> fits;
  const std::size_t last = fewest_bounces(maps);
  Progress progress("fitting bounces", static_cast<std::int64_t>(last), watch);
  for (std::size_t bounce = 1; bounce <= last; ++bounce) {
    progress.throw_if_stopped();
    BounceFit& one = fits.emplace_back();
    one.bounce = bounce;
    const FormFamily family = make_bounce_family(bounce, start);
    const std::vector<FitPoint> points = collect_points(family, maps);
    one.peak = highest_mean(points);
    try {
      const LeastSquaresFit fit = fit_family(family, points, std::vector<double>(maps.size(), 1));
      const ParameterIntervals intervals =
          bootstrap_family(family, points, maps, fit.parameters, draws, seed + bounce);
      one.constants = to_constants(fit.parameters);
      if (!(one.constants[0] < kLargestGain))
        throw Error("the fit of " + family.name + ": A runs away, the data do not determine it");
      start = one.constants;
      one.low = to_constants(intervals.low);
      one.high = to_constants(intervals.high);
      one.high[0] = std::min(one.high[0], kLargestGain);
      one.rms = fit.rms;
    } catch (const Error& error) {
      one.fault = error.what();
    }
    progress.add(1);
  }
  return fits;
}

}  // namespace heightlight
