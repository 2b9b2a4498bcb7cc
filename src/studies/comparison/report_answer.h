#pragma once

#include <cstdio>
#include <string>

#include "comparison/report.h"

namespace heightlight {

/// A name as it is, whatever marks it has.
std::string as_markdown(const std::string& name);

/// What the report begins with: the answer in words, the table of forms on exact AO and on that of games, and
/// the user's own forms.
void write_answer(std::FILE* file, const ReportInput& input);

}  // namespace heightlight
