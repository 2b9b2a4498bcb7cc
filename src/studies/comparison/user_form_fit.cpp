#include "comparison/user_form_fit.h"

#include <cmath>

#include "fit/error_tally.h"
#include "fit/fit_points.h"
#include "fit/trial_forms.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

constexpr int kMostTexels = 16384;

/// Texels of every k-th row and column. Those of the left half of the map are of map 0, the others of map 1.
std::vector<FitPoint> sample_texels(const ComparedScene& scene, const ComparisonReference& reference) {
  const int width = scene.surface.width();
  const int height = scene.surface.height();
  int step = 1;
  while (((width + step - 1) / step) * ((height + step - 1) / step) > kMostTexels) ++step;
  std::vector<FitPoint> points;
  for (int row = 0; row < height; row += step) {
    for (int column = 0; column < width; column += step) {
      const std::size_t i = reference.sky_view_factor.index(row, column);
      if (std::isnan(reference.sky_view_factor.values[i])) continue;
      FitPoint point;
      point.map = 2 * column < width ? 0 : 1;
      point.inputs.ambient_occlusion = AmbientOcclusion(double{reference.ambient_occlusion.values[i]});
      point.inputs.sky_view_factor = SkyViewFactor(double{reference.sky_view_factor.values[i]});
      point.inputs.seen = SeenSkyViewFactor(double{reference.seen.values[i]});
      for (std::size_t a = 0; a < scene.albedos.size(); ++a) {
        point.albedos.push_back(scene.albedos[a].reflectance[i]);
        point.measured.push_back(double{reference.totals[a].values[i]});
      }
      points.push_back(std::move(point));
    }
  }
  for (FitPoint& point : points) point.weight = 1 / static_cast<double>(points.size());
  return points;
}

/// Where the form is not finite it errs by nothing; how often that is stands elsewhere.
ErrorTally judge(const UserForm& form, const std::vector<double>& constants,
                 const std::vector<FitPoint>& points, std::size_t half) {
  ErrorTally tally;
  for (const FitPoint& point : points) {
    if (point.map != half) continue;
    for (std::size_t k = 0; k < point.albedos.size(); ++k) {
      const double total = evaluate(form, point.inputs, point.albedos[k], constants);
      if (std::isfinite(total)) tally.add(total - point.measured[k], point.weight);
    }
  }
  return tally;
}

}  // namespace

FormOnMap fit_on_map(const UserForm& form, const ComparedScene& scene, const ComparisonReference& reference) {
  const std::vector<FitPoint> points = sample_texels(scene, reference);
  const auto fit_to = [&](const std::vector<double>& halves) -> std::vector<double> {
    if (form.expression.constants.empty()) return {};
    const Eigen::VectorXd fitted = fit_family(make_user_family(form), points, halves).parameters;
    return {fitted.data(), fitted.data() + fitted.size()};
  };
  FormOnMap found{.form = form, .constants = fit_to({1, 1})};
  ErrorTally all;
  ErrorTally left_out;
  for (const std::size_t half : {0, 1}) {
    all.add(judge(form, found.constants, points, half));
    const bool is_first = half == 0;
    left_out.add(judge(form, fit_to({is_first ? 0.0 : 1.0, is_first ? 1.0 : 0.0}), points, half));
  }
  if (!points.empty() && all.weight <= 0)
    throw UsageError("form", form.name, "has no finite value on any texel of the map");
  found.rms = all.rms();
  found.left_out_rms = left_out.rms();
  return found;
}

}  // namespace heightlight
