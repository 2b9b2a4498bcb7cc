#pragma once

#include <pybind11/pybind11.h>

#include "heightlight/curves.h"

namespace heightlight {

namespace py = pybind11;

/// Curves as columns of one length, a row per filled bin and bounce: bin, ao_lo, ao_hi, ao_mean, count,
/// bounce, mean, stddev, p05, p50, p95; the tail's bounce is −1. With them `kind` and `bins`.
py::dict curve_table(const BounceCurves& curves);

/// The same back. Throws UsageError for columns that are missing or of unlike lengths, and for rows that are
/// no curves.
BounceCurves read_curve_table(const py::dict& table);

}  // namespace heightlight
