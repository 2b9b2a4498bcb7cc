#pragma once

#include <filesystem>
#include <vector>

#include "fit/fit_report.h"

namespace heightlight {

/// Writes report.html; `curves` are the files that were read, `seconds` what all took. Throws Error for one
/// that cannot be read any more, OutputError.
void write_fit_page(const std::filesystem::path& path, const FitReport& report,
                    const std::vector<std::filesystem::path>& curves, double seconds);

}  // namespace heightlight
