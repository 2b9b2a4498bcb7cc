#pragma once

#include "heightlight/curves.h"

namespace gnuplotio {
class Gnuplot;
}

namespace heightlight {

// Two panels of the figure of one map's curves that put the notes' τ (Patapom, eqs. 8 to 10) on trial.

/// Makes their tables known to the script; before the multiplot.
void send_tau_tables(gnuplotio::Gnuplot& script, const BounceCurves& over_alpha);

/// E_{b+1}/E_b over α, beside τ by eq. 9.
void send_ratio_panel(gnuplotio::Gnuplot& script, const BounceCurves& over_alpha);

/// What bounces bring at an albedo over what they bring at 1, at some α: as measured, and by the series of
/// the τ that eq. 9 gives there.
void send_saturation_panel(gnuplotio::Gnuplot& script, const BounceCurves& over_alpha);

}  // namespace heightlight
