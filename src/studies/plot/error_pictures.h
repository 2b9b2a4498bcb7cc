#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "comparison/compare_methods.h"
#include "files/image_file.h"

namespace heightlight {

/// Differences of this size have the full colour: the one scale of all error pictures.
constexpr double kFullDifference = 0.2;

/// Blue where a map is below its reference, white where it agrees, red where it is above; NaN is
/// kMissingColour. One pixel per texel.
Image<Rgb8> difference_picture(const Map& differences);

/// What a sheet of error pictures says of itself.
struct ErrorSheet {
  std::string title;
  std::string quantity;  ///< "sky view factor, method − reference"
  int columns = 4;
};

/// All maps on one sheet, with names and a scale, as PNG; the place of a map of 0 × 0 stays empty. Throws
/// Error naming gnuplot or the file.
void plot_error_sheet(const std::filesystem::path& png, const std::vector<ErrorMap>& maps,
                      const ErrorSheet& sheet);

}  // namespace heightlight
