#pragma once

#include <string>
#include <vector>

#include "method.h"

namespace heightlight {

/// What every method is measured against: values at some receivers.
struct ReferenceValues {
  Receivers receivers;
  std::vector<float> values;
};

/// What a method needs to come as close to the reference as asked, for the whole map.
struct TimeToError {
  std::string method;
  std::string parameter;
  bool is_baseline = false;
  double target = 0;          ///< root mean square error wanted
  bool reached = false;       ///< false: no setting comes so close, and what follows is the dearest's
  int setting = 0;            ///< the cheapest that reaches it
  double rmse = 0;            ///< measured with that setting
  bool extrapolated = false;  ///< from some rows to the whole map
  Cost set_up;
  Cost run;
  Cost run_by_one_thread;  ///< for the last target only

  Cost total() const { return set_up + run; }
};

/// Finds, for each of the `targets` (falling), the cheapest setting that reaches it, and what it costs. A
/// method that is told an error is told the target first; where it misses, it is asked for ever less.
std::vector<TimeToError> time_to_error(const Method& method, const Surface& surface,
                                       const ReferenceValues& reference, const std::vector<double>& targets);

/// A method with one of its settings.
struct CurvePoint {
  std::string method;
  std::string parameter;
  int setting = 0;
  double rmse = 0;
  bool extrapolated = false;
  Cost set_up;
  Cost run;

  Cost total() const { return set_up + run; }
};

/// All of the method's settings, up to the first that comes closer to the reference than `least_error`.
std::vector<CurvePoint> error_curve(const Method& method, const Surface& surface,
                                    const ReferenceValues& reference, double least_error);

}  // namespace heightlight
