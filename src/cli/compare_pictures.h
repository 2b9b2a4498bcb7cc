#pragma once

#include <string>
#include <vector>

#include "cli/plots.h"
#include "comparison/report.h"
#include "files/staged_output.h"

namespace heightlight {

/// "error_03_gtao.png" of the number-th method that is drawn.
std::string error_picture_name(std::size_t number, std::string method);

/// The errors of A, a picture for each method that is shown, one pixel per texel.
void write_error_pictures(StagedFolder& folder, const std::vector<ErrorMap>& maps);

/// The forms over AO, time against error, and the sheets of errors.
void draw_comparison(StagedFolder& folder, const ReportInput& input, Plots& plots);

}  // namespace heightlight
