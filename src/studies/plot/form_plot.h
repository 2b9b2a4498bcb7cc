#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "comparison/form_panels.h"

namespace heightlight {

/// Draws E/π over AO: what was measured, with its spread, and each form as a curve. A row of panels for each
/// AO, a column for each albedo. As SVG and as PNG. Throws Error naming gnuplot or the file.
void plot_forms(const std::filesystem::path& svg, const std::filesystem::path& png,
                const std::vector<FormPanel>& panels, const std::string& title);

}  // namespace heightlight
