#pragma once

#include <vector>

#include "fit/fit_report.h"
#include "heightlight/closed_forms.h"
#include "plot/bounce_fit_plots.h"
#include "plot/fit_plots.h"

namespace heightlight {

/// Forms of AO alone over the bin means of all maps together.
std::vector<FittedPanel> fitted_panels(const FitReport& report);

/// Single bounces over the bins of all maps together, and what was fitted to them.
BounceFitPlotInput bounce_fit_input(const FitReport& report);

/// For plot_saturation: from bins of all maps together, at every fifth of α.
PlotTable saturation_table(const FitReport& report);

CubicPanel cubic_panel(const FitReport& report);

/// Constants as fitted here; those of the defaults where a family could not be fitted.
ShaderConstants shader_constants(const FitReport& report);

/// The notes' constants as fitted here, F₀ bounded by 1; the published ones where they could not be fitted.
NotesConstants refitted_notes(const FitReport& report);

}  // namespace heightlight
