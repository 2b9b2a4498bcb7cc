#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "comparison/compare_methods.h"

namespace heightlight {

/// One panel of the figure.
struct ParetoPanel {
  std::string quantity;
  double reference_error = 0;  ///< the reference's own, as a line; 0: none is known
};

/// Draws RMSE against core-seconds, log–log: methods by colour, the closed forms that were tried on their AO
/// by mark, and through the points that none beats in both the Pareto front, with their parameters. As SVG
/// and as PNG. Throws Error naming gnuplot or the file.
void plot_pareto(const std::filesystem::path& svg, const std::filesystem::path& png,
                 const std::vector<ComparisonRow>& rows, const std::vector<ParetoPanel>& panels,
                 const std::string& title);

}  // namespace heightlight
