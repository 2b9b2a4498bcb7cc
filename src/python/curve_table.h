#pragma once

#include <pybind11/pybind11.h>

#include "heightlight/curves.h"

namespace heightlight {

namespace py = pybind11;

/// Converts curves to columns of equal length, with a row per filled bin and bounce: bin, ao_lo, ao_hi,
/// ao_mean, count, bounce, mean, stddev, p05, p50, p95. The tail's bounce is −1. The dict also holds `kind`
/// and `bins`.
py::dict curve_table(const BounceCurves& curves);

/// Converts such a table back to curves. Throws UsageError for missing columns, columns of unequal length,
/// and rows that do not form curves.
BounceCurves read_curve_table(const py::dict& table);

}  // namespace heightlight
