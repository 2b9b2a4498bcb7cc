#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "heightlight/files.h"
#include "heightlight/surface.h"
#include "terrain/terrain_study.h"

namespace heightlight {

/// What the report is about.
struct TerrainReportInput {
  std::string map_name;
  const Surface& surface;
  const TerrainStudy& study;
  const std::vector<Warning>& warnings;
};

/// Writes a page of Markdown: warnings, what each formula of reflected light errs by, and what the usual
/// algorithms for sky view factors cost and err by beside ours. Throws Error naming the file.
void write_terrain_report(const std::filesystem::path& path, const TerrainReportInput& input);

}  // namespace heightlight
