#pragma once

#include <vector>

#include "cli/fit_report.h"
#include "heightlight/closed_forms.h"
#include "plot/fit_plots.h"

namespace heightlight {

/// Forms of AO alone over the bin means of all maps together.
std::vector<FittedPanel> fitted_panels(const FitReport& report);

CubicPanel cubic_panel(const FitReport& report);

/// Constants as fitted here; those of the defaults where a family could not be fitted.
ShaderConstants shader_constants(const FitReport& report);

/// The notes' constants as fitted here, F₀ bounded by 1; the published ones where they could not be fitted.
NotesConstants refitted_notes(const FitReport& report);

}  // namespace heightlight
