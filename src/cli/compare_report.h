#pragma once

#include <filesystem>
#include <vector>

#include "comparison/report.h"
#include "report/page.h"

namespace heightlight {

/// Bytes of the report's pictures, and of the page while it is made.
std::uint64_t comparison_report_bytes(const Surface& surface, std::size_t albedos);

/// Writes report.html of what was read from `inputs`; `seconds` is what all took. Throws OutputError.
void write_comparison_report(const std::filesystem::path& path, const std::vector<PageFact>& inputs,
                             const ReportInput& input, double seconds);

}  // namespace heightlight
