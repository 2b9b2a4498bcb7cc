#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "comparison/compare_methods.h"

namespace heightlight {

/// Draws RMSE against core-seconds, log–log, one panel per quantity (one to four of them), one kind of point
/// per method, and through the points that none beats in both the Pareto front, with their parameters. As SVG
/// and as PNG. Throws Error naming gnuplot or the file.
void plot_pareto(const std::filesystem::path& svg, const std::filesystem::path& png,
                 const std::vector<ComparisonRow>& rows, const std::vector<std::string>& quantities,
                 const std::string& title);

}  // namespace heightlight
