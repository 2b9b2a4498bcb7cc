#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "bake/texture_files.h"

namespace heightlight {

/// Bytes of the report's pictures, and of the page while it is made; 0 where none is wanted.
std::uint64_t bake_report_bytes(int width, int height, const BakeOptions& options);

/// Writes the report of a bake, for which `others` may have been read beside the map. Throws OutputError.
void write_bake_report(const std::filesystem::path& path, const ReportedBake& bake,
                       const std::vector<std::filesystem::path>& others);

}  // namespace heightlight
