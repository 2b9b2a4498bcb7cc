#include "cli/reach_options.h"

#include <cstdlib>

#include "heightlight/error.h"

namespace heightlight {

double parse_distance(const std::string& quantity, const std::string& text, double width) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const std::string unit = end;
  if (end == text.c_str() || (!unit.empty() && unit != "%")) {
    throw UsageError(quantity, text,
                     "must be a length in world units, or a percentage of the width, such as 5%");
  }
  return unit.empty() ? value : value / 100 * width;
}

}  // namespace heightlight
