#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "comparison/report.h"
#include "files/file_record.h"
#include "heightlight/files.h"

namespace heightlight {

/// compare.json: the map, the answer, the user's forms, what the reference errs by, and the evidence of its
/// totals.
std::string comparison_json(const std::filesystem::path& map, const LoadedHeightmap& loaded,
                            const ReportInput& input, const std::vector<FileRecord>& files);

}  // namespace heightlight
