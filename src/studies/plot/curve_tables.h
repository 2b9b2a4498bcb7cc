#pragma once

#include <vector>

#include "heightlight/curves.h"
#include "plot/gnuplot_run.h"

namespace heightlight {

// In tables by bin a row of NaN stands where bins are empty, which breaks lines there. A bin without
// neighbours has two rows, from ao_lo to ao_hi. Without any bin there is one row, outside the axes: gnuplot
// complains of tables without a valid point.

/// The last bounce K of curves with at least E₀; 0 where no bin is filled.
int last_bounce(const BounceCurves& curves);

/// The bins that hold at least 30 texels, and one in 400: what fewer say is noise.
BounceCurves well_filled(const BounceCurves& curves);

/// ao_mean, bin centre, bin width, count, then p05 and p95 of E₀/π, then the means of E₀/π … E_K/π.
PlotTable bounce_table(const BounceCurves& curves);

/// ao_mean, then E₀, E₀ + E₁, … , E₀ + … + E_K, and that with the tail; all over π.
PlotTable sum_table(const BounceCurves& curves);

/// One scan per bounce 1 … K of the points (ao, bounce, mean), all of as many points, from at most 100 bins:
/// more are taken together. NaN where no texel is.
std::vector<PlotTable> surface_table(const BounceCurves& curves);

}  // namespace heightlight
