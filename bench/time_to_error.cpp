#include "time_to_error.h"

#include <algorithm>
#include <cmath>

namespace heightlight {
namespace {

constexpr int kRows = 32;  // these rows represent the map: 16384 receivers or more

void set_up(const Method& method, int setting) {
  if (method.set_up) method.set_up(setting);
}

/// The method's values at the reference's receivers; the method must be set up.
std::vector<float> values_at(const Method& method, int setting, const Receivers& receivers) {
  if (method.run_receivers) return method.run_receivers(setting, receivers);
  const Map map = method.run_map(setting);
  std::vector<float> values(receivers.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = map.values[receivers[i]];
  return values;
}

double measure_error(const Method& method, int setting, const ReferenceValues& reference) {
  set_up(method, setting);
  return rmse(values_at(method, setting, reference.receivers), reference.values);
}

/// Times a method, on the whole map or on some rows, from which the cost of the map is extrapolated.
class TimedRun {
 public:
  TimedRun(const Method& method, const Surface& surface, int rows = kRows) : method_(method) {
    if (method.run_map) return;
    rows_ = row_receivers(surface, rows);
    factor_ = static_cast<double>(surface.map.height.size()) / static_cast<double>(rows_.size());
  }

  bool extrapolates() const { return !method_.run_map; }

  Cost cost(int setting) const {
    return factor_ * least_cost([&] {
             if (method_.run_map) {
               method_.run_map(setting);
             } else {
               method_.run_receivers(setting, rows_);
             }
           });
  }

 private:
  const Method& method_;
  Receivers rows_;
  double factor_ = 1;
};

/// A setting that was tried, and its error.
struct Rung {
  int setting;
  double rmse;
};

/// Tries settings, cheapest first, until one reaches the target.
std::vector<Rung> climb(const Method& method, const ReferenceValues& reference, double target) {
  std::vector<Rung> rungs;
  for (const int setting : method.settings) {
    rungs.push_back({setting, measure_error(method, setting, reference)});
    if (rungs.back().rmse <= target) break;
  }
  return rungs;
}

int round_up(double setting, int granularity) {
  return static_cast<int>(std::ceil(setting / granularity - 1e-9)) * granularity;
}

/// The cheapest setting that reaches the target, including settings between those tried. A power law through
/// the last one above the target and the first one below it gives a start; from there, settings rise until
/// the measured error reaches the target. Returns the last one tried if none reaches it.
Rung cheapest_rung(const Method& method, const ReferenceValues& reference, const std::vector<Rung>& rungs,
                   double target) {
  const auto below =
      std::find_if(rungs.begin(), rungs.end(), [target](const Rung& rung) { return rung.rmse <= target; });
  if (below == rungs.end()) return rungs.back();
  if (below == rungs.begin()) return *below;
  constexpr double kStep = 1.03;
  const Rung& above = *(below - 1);
  const double share = std::log(target / above.rmse) / std::log(below->rmse / above.rmse);
  double setting = above.setting * std::pow(static_cast<double>(below->setting) / above.setting, share);
  for (;; setting *= kStep) {
    Rung rung{round_up(setting, method.granularity), 0};
    if (rung.setting >= below->setting) return *below;
    rung.rmse = measure_error(method, rung.setting, reference);
    if (rung.rmse <= target) return rung;
  }
}

/// The first setting that reaches the target, beginning with the one that asks for the target, and then
/// asking for smaller errors. Returns the last one tried if none reaches it.
Rung asked_rung(const Method& method, const ReferenceValues& reference, double target) {
  constexpr double kStep = 1.1;
  double setting = method.setting_for(target);
  for (;; setting *= kStep) {
    Rung rung{static_cast<int>(std::lround(setting)), 0};
    rung.rmse = measure_error(method, rung.setting, reference);
    if (rung.rmse <= target || setting > method.settings.back()) return rung;
  }
}

Cost one_thread_cost(const TimedRun& run, int setting) {
  const ThreadScope one_thread(1);
  return run.cost(setting);
}

}  // namespace

std::vector<TimeToError> time_to_error(const Method& method, const Surface& surface,
                                       const ReferenceValues& reference, const std::vector<double>& targets) {
  std::vector<Rung> rungs;
  if (!method.setting_for) rungs = climb(method, reference, targets.back());
  const TimedRun run(method, surface);
  std::vector<TimeToError> results;
  for (const double target : targets) {
    const Rung rung = method.setting_for ? asked_rung(method, reference, target)
                                         : cheapest_rung(method, reference, rungs, target);
    const Cost set_up_cost = least_cost([&] { set_up(method, rung.setting); });
    TimeToError result;
    result.method = method.name;
    result.parameter = method.parameter;
    result.is_baseline = method.is_baseline;
    result.target = target;
    result.reached = rung.rmse <= target;
    result.setting = rung.setting;
    result.rmse = rung.rmse;
    result.extrapolated = run.extrapolates();
    result.set_up = method.built + set_up_cost;
    result.run = run.cost(rung.setting);
    if (target == targets.back()) result.run_by_one_thread = one_thread_cost(run, rung.setting);
    results.push_back(result);
  }
  return results;
}

std::vector<CurvePoint> error_curve(const Method& method, const Surface& surface,
                                    const ReferenceValues& reference, double least_error) {
  constexpr int kCurveRows = 8;  // more rows make no visible difference in a plot
  const TimedRun run(method, surface, kCurveRows);
  std::vector<CurvePoint> curve;
  for (const Rung& rung : climb(method, reference, least_error)) {
    CurvePoint point;
    point.method = method.name;
    point.parameter = method.parameter;
    point.setting = rung.setting;
    point.rmse = rung.rmse;
    point.extrapolated = run.extrapolates();
    point.set_up = method.built + least_cost([&] { set_up(method, rung.setting); });
    point.run = run.cost(rung.setting);
    curve.push_back(point);
  }
  return curve;
}

}  // namespace heightlight
