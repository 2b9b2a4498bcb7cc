#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "heightlight/files.h"
#include "shading/directional_study.h"
#include "shading/specular_study.h"

namespace heightlight {

/// What a report says of its map.
struct ShadingReportHead {
  std::string map_name;
  const Surface& surface;
  const std::vector<Warning>& warnings;
};

/// Pages of Markdown: warnings, the answer, winners, and tables of errors and costs. Both throw Error naming
/// the file.
void write_specular_report(const std::filesystem::path& path, const ShadingReportHead& head,
                           const SpecularStudy& study, const std::vector<Vector3>& views);
void write_directional_report(const std::filesystem::path& path, const ShadingReportHead& head,
                              const DirectionalStudy& study);

}  // namespace heightlight
