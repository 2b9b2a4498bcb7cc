#pragma once

#include <filesystem>
#include <vector>

#include "comparison/compare_methods.h"
#include "files/image_file.h"

namespace heightlight {

/// Differences of this size have the full colour: the one scale of all error pictures.
constexpr double kFullDifference = 0.2;

/// Blue where a map is below its reference, white where it agrees, red where it is above; NaN is
/// kMissingColour. One pixel per texel.
Image<Rgb8> difference_picture(const Map& differences);

/// All of them on one sheet, with names and a scale, as PNG. Throws Error naming gnuplot or the file.
void plot_error_sheet(const std::filesystem::path& png, const std::vector<ErrorMap>& maps,
                      const std::string& title);

}  // namespace heightlight
