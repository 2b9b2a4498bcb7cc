#pragma once

#include <string>
#include <vector>

#include "method.h"

namespace heightlight {

/// The reference for all methods: values at some receivers.
struct ReferenceValues {
  Receivers receivers;
  std::vector<float> values;
};

/// What a method needs for the whole map to reach a target RMSE.
struct TimeToError {
  std::string method;
  std::string parameter;
  bool is_baseline = false;
  double target = 0;          ///< root mean square error wanted
  bool reached = false;       ///< if not, the fields below are those of the last setting tried
  int setting = 0;            ///< the cheapest setting found that reaches the target
  double rmse = 0;            ///< measured with that setting
  bool extrapolated = false;  ///< whether costs are extrapolated from some rows to the whole map
  Cost set_up;
  Cost run;
  Cost run_by_one_thread;  ///< for the last target only

  Cost total() const { return set_up + run; }
};

/// Finds, for each of the `targets` (falling), the cheapest setting that reaches it, and its cost. A method
/// that plans for an error is first given the target; where it misses, it is asked for smaller and smaller
/// errors.
std::vector<TimeToError> time_to_error(const Method& method, const Surface& surface,
                                       const ReferenceValues& reference, const std::vector<double>& targets);

/// A method with one of its settings, and what it errs by and costs.
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

/// Evaluates the method's settings, up to the first whose RMSE against the reference is at most
/// `least_error`.
std::vector<CurvePoint> error_curve(const Method& method, const Surface& surface,
                                    const ReferenceValues& reference, double least_error);

}  // namespace heightlight
