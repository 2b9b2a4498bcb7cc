#include "fit/fit_study.h"

#include <string>

#include "base/progress.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

/// The root mean square that the published parameters leave.
double rms_as_published(const FormFamily& family, const std::vector<FitPoint>& points) {
  const Eigen::VectorXd published = Eigen::Map<const Eigen::VectorXd>(
      family.published.data(), static_cast<Eigen::Index>(family.published.size()));
  const std::vector<double>& albedos = target_albedos(family.target);
  ErrorTally tally;
  for (const FitPoint& point : points) {
    for (std::size_t k = 0; k < albedos.size(); ++k) {
      tally.add(family.evaluate(published, point.inputs, albedos[k]) - point.measured[k], point.weight);
    }
  }
  return tally.rms();
}

/// Families that no map has the inputs for are left out.
std::vector<FittedFamily> fit_families(const FitStudy& study, const TrialForms& trial,
                                       const std::vector<JudgedMap>& maps) {
  const std::vector<double> weights(maps.size(), 1);
  std::vector<FittedFamily> fitted;
  Progress progress("fitting", static_cast<std::int64_t>(trial.families.size()), study.watch);
  for (const FormFamily& family : trial.families) {
    progress.throw_if_stopped();
    const std::vector<FitPoint> points = collect_points(family, maps);
    progress.add(1);
    if (points.empty()) continue;
    // Built in place: g++ 12 warns falsely of a moved one's intervals.
    FittedFamily& one = fitted.emplace_back();
    one.family = &family;
    one.fit = fit_family(family, points, weights);
    one.intervals = bootstrap_family(family, points, maps, one.fit.parameters, study.draws, study.seed);
    one.published_rms = rms_as_published(family, points);
  }
  return fitted;
}

std::vector<AlbedoCubic> cubics_by_albedo(const std::vector<JudgedMap>& maps, const char* name) {
  for (const FormFamily& family : form_families()) {
    if (family.name == name) return fit_cubics(collect_points(family, maps), target_albedos(family.target));
  }
  return {};
}

}  // namespace

void check_bootstrap(int draws) {
  if (draws >= 20 && draws <= 100000) return;
  throw UsageError("bootstrap", std::to_string(draws), "must be from 20 to 100000");
}

FitReport fit_maps(std::vector<JudgedMap> maps, const std::vector<UserForm>& own, const FitStudy& study) {
  check_bootstrap(study.draws);
  FitReport report;
  report.seed = study.seed;
  report.maps = std::move(maps);
  report.forms = list_trial_forms(own);
  report.families = fit_families(study, report.forms, report.maps);
  report.cubics_three_bounces = cubics_by_albedo(report.maps, "cubic_three_bounces");
  report.cubics_all_bounces = cubics_by_albedo(report.maps, "cubic");
  report.bounce_fits = fit_bounces(report.maps, study.draws, study.seed, study.watch);
  for (const JudgedMap& map : report.maps)
    report.ratios.push_back(find_bounce_ratios(map.name, map.over_alpha));
  report.trial = cross_validate(report.maps, report.forms, study.watch);
  report.floors = find_floors(report.maps);
  return report;
}

}  // namespace heightlight
