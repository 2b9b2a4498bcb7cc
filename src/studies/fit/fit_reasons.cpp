#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "fit/fit_report.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

/// The notes' table: bins of equal weight at i/100, however many texels they hold and wherever those lie.
std::vector<FitPoint> by_the_notes(const FormFamily& family, const std::vector<JudgedMap>& maps) {
  std::vector<FitPoint> points = collect_points(family, maps);
  std::size_t i = 0;
  for (const JudgedMap& map : maps) {
    for (const CurveBin& bin : map.over_alpha.filled) {
      points[i].weight = 1;
      points[i].inputs.ambient_occlusion = AmbientOcclusion(bin.ao_lo);
      ++i;
    }
  }
  return points;
}

std::string describe_parameters(const FormFamily& family, const Eigen::VectorXd& parameters) {
  std::string text;
  for (std::size_t p = 0; p < family.parameters.size(); ++p) {
    text += (p > 0 ? ", " : "") +
            fmt::format("{} {:.4g}", family.parameters[p], parameters[static_cast<Eigen::Index>(p)]);
  }
  return text;
}

std::string explain_conventions(const FormFamily& family, const std::vector<JudgedMap>& maps) {
  const std::vector<double> weights(maps.size(), 1);
  const LeastSquaresFit fit = fit_family(family, by_the_notes(family, maps), weights);
  return "why: " + family.name + " with bins of equal weight tabulated at i/100, as in the notes: " +
         describe_parameters(family, fit.parameters);
}

/// How far apart single maps are, each fitted alone: where the middle half of them lies.
std::string explain_maps(const FittedFamily& fitted, const std::vector<JudgedMap>& maps) {
  const FormFamily& family = *fitted.family;
  const std::vector<FitPoint> points = collect_points(family, maps);
  std::vector<std::vector<double>> alone(family.parameters.size());
  for (std::size_t map = 0; map < maps.size(); ++map) {
    std::vector<double> weights(maps.size(), 0);
    weights[map] = 1;
    try {
      const LeastSquaresFit fit = fit_family(family, points, weights);
      for (std::size_t p = 0; p < alone.size(); ++p) {
        alone[p].push_back(fit.parameters[static_cast<Eigen::Index>(p)]);
      }
    } catch (const Error&) {
      // a map of few bins, close together, that don't determine the fit
    }
  }
  const std::size_t count = alone.front().size();
  std::string text =
      "why: " + family.name + fmt::format(" to each of {} maps alone, the middle half: ", count);
  for (std::size_t p = 0; p < alone.size() && count > 0; ++p) {
    std::sort(alone[p].begin(), alone[p].end());
    text += (p > 0 ? ", " : "") + fmt::format("{} {:.4g} … {:.4g}", family.parameters[p], alone[p][count / 4],
                                              alone[p][count - 1 - count / 4]);
  }
  return text;
}

/// What the bounces after the third bring at ρ = 0.9 and A = ½.
std::string explain_bounces(const FittedFamily& three, const FittedFamily& all) {
  ModelInputs half;
  half.sky_view_factor = SkyViewFactor(0.5);
  const double with_three = three.family->evaluate(three.fit.parameters, half, 0.9);
  const double with_all = all.family->evaluate(all.fit.parameters, half, 0.9);
  return fmt::format(
      "why: the cubic at A = 0.5, albedo 0.9: {:.3f} of three bounces, {:.3f} of all, {:.3f} as published",
      with_three, with_all, cubic_total(SkyViewFactor(0.5), 0.9));
}

}  // namespace

std::vector<std::string> explain_distances(const FitReport& report) {
  std::vector<std::string> reasons;
  for (const char* name : {"notes_direct", "notes_first_bounce"}) {
    const FittedFamily* fitted = find_family(report, name);
    if (!fitted) continue;
    reasons.push_back(explain_conventions(*fitted->family, report.maps));
    if (report.maps.size() > 1) reasons.push_back(explain_maps(*fitted, report.maps));
  }
  const FittedFamily* three = find_family(report, "cubic_three_bounces");
  const FittedFamily* all = find_family(report, "cubic");
  if (three && all) reasons.push_back(explain_bounces(*three, *all));
  return reasons;
}

}  // namespace heightlight
