#pragma once

#include <filesystem>
#include <vector>

#include "fit/bounce_ratios.h"
#include "plot/gnuplot_run.h"

namespace heightlight {

/// E_{b+1}/E_b over α for every b, beside τ by eq. 9 on the data and as published: at most twelve maps, from
/// the least spread to the greatest. As SVG and as PNG. Both throw as plot_curves does.
void plot_ratios(const std::filesystem::path& svg, const std::filesystem::path& png,
                 std::vector<BounceRatios> ratios);

/// How bounces saturate colour: what they bring at an albedo over what they bring at 1, by the notes'
/// geometric series at several τ, and as measured at several α, whose τ by eq. 9 is known. Rows of
/// `measured`: ρ, that share, τ.
void plot_saturation(const std::filesystem::path& svg, const std::filesystem::path& png,
                     const PlotTable& measured);

}  // namespace heightlight
