#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fit/cross_validation.h"
#include "fit/cubic_by_albedo.h"
#include "plot/curve_tables.h"
#include "plot/gnuplot_run.h"

namespace heightlight {

/// One form against what was measured: rows of AO, then E/π at ρ = 0, 0.1 … 1.
struct FittedPanel {
  std::string title;
  AoKind kind = AoKind::sky_view_factor;
  PlotTable measured;  ///< NaN where no texel is
  PlotTable fitted;
};

/// Coefficients of one cubic by albedo: as fitted to each, and the line through them.
struct CubicPanel {
  std::vector<AlbedoCubic> three_bounces;
  std::vector<AlbedoCubic> all_bounces;
  CubicConstants three_bounces_line;
  CubicConstants all_bounces_line;
};

/// The notes' last figure: forms (thick) over measured bin means (red), ρ = 0 to 1.
GnuplotResult draw_fitted(bool is_svg, const std::vector<FittedPanel>& panels);

/// Jimenez et al. 2016, figure 4: RMS error over the form's AO at ρ = 0.1 … 0.9, a panel for each form, its
/// overall errors in the title; errors on a logarithmic axis.
GnuplotResult draw_errors(bool is_svg, const std::vector<JudgedForm>& forms);

/// Jimenez et al. 2016, figure 18: the cubic's coefficients by albedo, fitted here and published.
GnuplotResult draw_cubics(bool is_svg, const CubicPanel& cubics);

/// Each of them as SVG and as PNG. They throw as plot_curves does.
void plot_fitted(const std::filesystem::path& svg, const std::filesystem::path& png,
                 const std::vector<FittedPanel>& panels);
void plot_errors(const std::filesystem::path& svg, const std::filesystem::path& png,
                 const std::vector<JudgedForm>& forms);
void plot_cubics(const std::filesystem::path& svg, const std::filesystem::path& png,
                 const CubicPanel& cubics);

}  // namespace heightlight
