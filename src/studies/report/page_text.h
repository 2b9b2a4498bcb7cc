#pragma once

#include <string_view>

namespace heightlight {

/// report.css, and the scripts beside it, as they were when the program was built (page_text.cpp.in).
extern const std::string_view kPageStyle;
extern const std::string_view kPageScript;

}  // namespace heightlight
