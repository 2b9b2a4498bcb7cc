#pragma once

#include "fit/fit_report.h"

namespace heightlight {

/// What is said on the terminal: how far from the published, and why; whether τ is one number; the errors.
void print_report(const FitReport& report);

}  // namespace heightlight
