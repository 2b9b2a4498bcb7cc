#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "comparison/compare_methods.h"
#include "heightlight/files.h"

namespace heightlight {

/// What the report is about.
struct ReportInput {
  std::string map_name;
  const ComparedScene& scene;
  const ComparisonReference& reference;
  const Comparison& comparison;
  Cost depth_cost;  ///< of the depth buffer, which screen-space methods are given
  const std::vector<Warning>& warnings;
};

/// Writes a page of Markdown: warnings, the reference and what it errs by, the cheapest method for each error
/// and quantity, what each method that is shown errs by, and what the closed forms add. Throws Error naming
/// the file.
void write_report(const std::filesystem::path& path, const ReportInput& input);

}  // namespace heightlight
