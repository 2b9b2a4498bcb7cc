#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fit/bounce_fits.h"
#include "plot/gnuplot_run.h"

namespace heightlight {

/// What the figure of the single bounces shows.
struct BounceFitPlotInput {
  PlotTable measured = {};  ///< AO, then E₀/π … E_K/π: bin means of all maps together, NaN where no texel is
  PlotTable spread = {};  ///< AO, then p05 and p95 of E₀/π and of E₁/π, likewise
  std::vector<BounceFit> fits = {};
  NotesConstants notes = {};  ///< as fitted here
};

/// The notes' figures of F₀, of F₁, and of the free fit of each bounce, and that fit's constants over the
/// bounce. As SVG and as PNG. Throws as plot_curves does.
void plot_bounce_fits(const std::filesystem::path& svg, const std::filesystem::path& png,
                      const BounceFitPlotInput& input);

}  // namespace heightlight
