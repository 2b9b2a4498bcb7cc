#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "heightlight/curves.h"
#include "plot/gnuplot_run.h"
#include "relief/relief_study.h"

namespace heightlight {

/// What the figure of one map's bounce curves shows; E₀ at least has been added to all of them.
struct CurvePlotInput {
  BounceCurves ambient_occlusion;     ///< over α, tail included
  BounceCurves sky_view_factor;       ///< over A; only its counts are drawn
  std::vector<ReliefCurves> reliefs;  ///< ascending; may be empty
  std::string title = {};             ///< any characters; empty for none
};

/// Draws the figure of the notes (Patapom) in eight panels, as SVG and as PNG: the bounces over α, their
/// surface over bounce and α, their sum, E₀ beside its simplifications, texels per bin, the first bounce by
/// relief, and whether τ is one number, over bounces and over albedos. Bins without texels leave gaps. Throws
/// Error naming gnuplot when it is not installed or fails, or the file that could not be written.
void plot_curves(const std::filesystem::path& svg, const std::filesystem::path& png,
                 const CurvePlotInput& input);

/// The same figure on any gnuplot terminal of 14 : 22.5, with what gnuplot had to say about it.
GnuplotResult draw_curves(const std::string& terminal, const CurvePlotInput& input);

}  // namespace heightlight
