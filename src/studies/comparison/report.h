#pragma once

#include <filesystem>
#include <string>

#include "comparison/compare_methods.h"

namespace heightlight {

/// What the report is about.
struct ReportInput {
  std::string map_name;
  const ComparedScene& scene;
  const ComparisonReference& reference;
  const Comparison& comparison;
  Cost depth_cost;  ///< of the depth buffer, which screen-space methods are given
};

/// Writes a page of Markdown: the reference and what it errs by, the cheapest method for each error and
/// quantity, what each method that is shown errs by, and what the closed forms add. Throws Error naming the
/// file.
void write_report(const std::filesystem::path& path, const ReportInput& input);

}  // namespace heightlight
