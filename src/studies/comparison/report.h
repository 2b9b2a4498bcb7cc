#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "comparison/answer.h"
#include "comparison/user_form_fit.h"
#include "heightlight/files.h"

namespace heightlight {

/// What the report is about.
struct ReportInput {
  std::string map_name;
  const ComparedScene& scene;
  const ComparisonReference& reference;
  const Comparison& comparison;
  const Answer& answer;
  const std::vector<FormOnMap>& own_forms;  ///< of the user
  Cost depth_cost;                          ///< of the depth buffer, which screen-space methods are given
  const std::vector<Warning>& warnings;
};

/// Writes a page of Markdown: warnings, the answer, the reference and what it errs by, the cheapest method
/// for each error and quantity, what each method that is shown errs by, what the closed forms add, and what
/// stages take. Throws Error naming the file.
void write_report(const std::filesystem::path& path, const ReportInput& input);

}  // namespace heightlight
